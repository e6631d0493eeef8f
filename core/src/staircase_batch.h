// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "staircase.h"

namespace cairn {

/// Eight steps of a staircase traversal, decided and moved together; structure of arrays.
struct alignas(64) StaircaseBatch {
  static constexpr std::uint32_t kSize = 8;

  // The sphere of the node that stays, in the frame of the tree whose node is split.
  float x[kSize], y[kSize], z[kSize], radius[kSize];
  std::uint32_t family[kSize];  // of the split node's children
  std::uint32_t lanes[kSize];  // as `TraversalNode::childLanes`, but leaves count only where the node that stays is one
  NodePair firstChild[kSize];  // the pair that lane 0 of the family would make
  std::uint32_t splitsA = 0;   // bit per step

  bool isIntoA(std::uint32_t step) const { return (splitsA >> step & 1U) != 0; }
  std::uint32_t cost(std::uint32_t step) const {
    return kSphereUpdateCost + TraversalNode::count(lanes[step]) * kOverlapTestCost;
  }
};

/// For every mask of hits the lanes that are hit, in order; the rest is 0. Hits are written down by looking the lanes
/// up: cheaper than compressing vectors, and the same on every instruction set.
struct HitLanes {
  alignas(64) std::uint8_t lanes[256][kFamilyWidth] = {};

  constexpr HitLanes() {
    for (std::uint32_t hits = 0; hits < 256; ++hits)
      for (std::uint32_t lane = 0, found = 0; lane < kFamilyWidth; ++lane)
        if ((hits >> lane & 1U) != 0) lanes[hits][found++] = static_cast<std::uint8_t>(lane);
  }
};
inline constexpr HitLanes kHitLanes;

}  // namespace cairn
