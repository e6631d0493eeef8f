// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>

#include "cairn/core/surface_patches.h"
#include "kernel/contact_limits.h"
#include "kernel/contact_tuning.h"
#include "kernel/placed_surface.h"

namespace cairn::bullet {

/// What may touch a piece of surface, in that surface's frame and unit; and how much farther lists look.
struct NearLimits {
  float reach = 0, depth = 0;  ///< heights above a face that may be those of contacts: at most, at least
  float margins = 0;
  float beside = 0;  ///< what lies so far beside a face may touch it, at least and, where it is deep, at most
  float besideDeep = 0;
  float skin = 0;  ///< bodies may move by so much: what touches then is so much farther off now, at most

  NearLimits() = default;
  NearLimits(float scale, const ContactLimits& limits) {
    const float unit = kRoundings / scale;
    setSkin(limits.skin / scale);
    const float reached = limits.reach + limits.margins;
    reach = reached < 0 ? reached / (kRoundings * scale) : reached * unit;
    depth = -limits.trustedDepth * unit;
    margins = limits.margins / scale;
    beside = tuning::kBeside * limits.contactDistance * unit;
    // On an edge contacts may point anywhere between its faces' normals: whatever the patch faces, they reach as far.
    besideDeep = std::max(limits.contactDistance, limits.reach + limits.margins) * unit;
  }

  void setSkin(float length) { skin = length * kRoundings; }
  /// A box around all that may touch the piece where bodies are. `normals` bound the directions that it faces.
  Box around(const Box& piece, const Box& normals) const {
    Box box = piece;
    for (int axis = 0; axis < 3; ++axis) {
      const float low = normals.lower[axis], high = normals.upper[axis];
      box.lower[axis] += std::min({0.0F, reach * low, depth * high}) - besideDeep;
      box.upper[axis] += std::max({0.0F, reach * high, depth * low}) + besideDeep;
    }
    return box;
  }

 private:
  // Of lengths; whoever decides does so by itself.
  static constexpr float kRoundings = 1 + 1e-4F;
};

}  // namespace cairn::bullet
