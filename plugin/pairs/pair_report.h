// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/core/budget.h"

namespace cairn::bullet {

/// What one pair contributes to the statistics of a step.
struct PairReport {
  std::uint32_t contacts = 0;
  std::uint32_t exactContacts = 0;  ///< of these, measured between source triangles
  std::uint32_t manifolds = 0;
  bool isUnresolved = false;
  bool isOfMesh = false;     ///< the meshes answered, if only that nothing touches
  double errorFraction = 0;  ///< worst certified error of its contacts and its front, of the smaller body's size
  double seenError = 0;      ///< the same as an angle in radians at which the viewer sees it; 0 without one
  Budget::Clock::duration onTriangles{};  ///< time spent past the leaves; measured only under a deadline
};

}  // namespace cairn::bullet
