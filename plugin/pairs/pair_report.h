// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/core/budget.h"

namespace cairn::bullet {

/// One pair's contribution to the statistics of a step.
struct PairReport {
  std::uint32_t contacts = 0;
  std::uint32_t exactContacts = 0;  ///< contacts measured between source triangles
  std::uint32_t manifolds = 0;
  bool isUnresolved = false;
  bool isOfMesh = false;     ///< the meshes answered, even if nothing touches
  double errorFraction = 0;  ///< worst certified error of contacts and front, as a fraction of the smaller body's size
  double seenError = 0;      ///< the same error as a viewing angle in radians; 0 without a viewer
  Budget::Clock::duration onTriangles{};  ///< time spent on triangles; measured only under a deadline
};

}  // namespace cairn::bullet
