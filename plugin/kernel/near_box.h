// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>

#include "cairn/core/surface_patches.h"
#include "kernel/placed_surface.h"

namespace cairn::bullet {

/// What may touch a piece of surface, as a box around it; in that surface's frame and unit.
struct NearLimits {
  float reach = 0, depth = 0;  ///< heights above a face that may be those of contacts: at most, at least (below 0)
  float beside = 0;            ///< what lies so far beside a face touches it

  NearLimits() = default;
  NearLimits(float scale, const ContactLimits& limits)
      : reach((limits.reach + limits.margins) * kRoundings / scale),
        depth((std::min(limits.margins, 0.0F) - limits.trustedDepth * kRoundings) / scale),
        beside(limits.contactDistance / scale) {}

  /// `normals` bound the directions that the piece faces.
  Box around(const Box& piece, const Box& normals) const {
    Box box = piece;
    for (int axis = 0; axis < 3; ++axis) {
      const float low = normals.lower[axis], high = normals.upper[axis];
      box.lower[axis] += std::min({0.0F, reach * low, depth * high}) - beside;
      box.upper[axis] += std::max({0.0F, reach * high, depth * low}) + beside;
    }
    return box;
  }

 private:
  // Whoever decides does so by itself.
  static constexpr float kRoundings = 1 + 1e-5F;
};

}  // namespace cairn::bullet
