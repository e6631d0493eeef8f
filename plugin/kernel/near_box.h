// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>

#include "cairn/core/surface_patches.h"
#include "kernel/contact_limits.h"
#include "kernel/contact_tuning.h"
#include "kernel/placed_surface.h"

namespace cairn::bullet {

/// The space around a piece of surface in which anything may touch it, in that surface's frame and unit, and the skin
/// of lists.
struct NearLimits {
  float maxSeparation = 0, depth = 0;  ///< greatest and least height above a face of a contact; `depth` is negative
  float margins = 0;
  /// Distance beside a face within which a point may touch it: the least value here, the greatest, for deep points, in
  /// `besideDeep`.
  float beside = 0;
  float besideDeep = 0;
  float skin = 0;  ///< displacement for which lists hold

  NearLimits() = default;
  NearLimits(float scale, const ContactLimits& limits) {
    const float unit = kRoundings / scale;
    setSkin(limits.skin / scale);
    const float reached = limits.maxSeparation + limits.margins;
    maxSeparation = reached < 0 ? reached / (kRoundings * scale) : reached * unit;
    depth = -limits.trustedDepth * unit;
    margins = limits.margins / scale;
    beside = tuning::kBeside * limits.contactDistance * unit;
    // On an edge a contact may point anywhere between its faces' normals, so it reaches equally far in all directions.
    besideDeep = std::max(limits.contactDistance, limits.maxSeparation + limits.margins) * unit;
  }

  void setSkin(float length) { skin = length * kRoundings; }
  /// A box around all that may touch the piece at the present placement. `normals` bounds the directions that the piece
  /// faces.
  Box around(const Box& piece, const Box& normals) const {
    Box box = piece;
    for (int axis = 0; axis < 3; ++axis) {
      const float low = normals.lower[axis], high = normals.upper[axis];
      box.lower[axis] += std::min({0.0F, maxSeparation * low, depth * high}) - besideDeep;
      box.upper[axis] += std::max({0.0F, maxSeparation * high, depth * low}) + besideDeep;
    }
    return box;
  }

 private:
  // Grows lengths, to cover rounding in these tests; the final decision on a contact does not use it.
  static constexpr float kRoundings = 1 + 1e-4F;
};

}  // namespace cairn::bullet
