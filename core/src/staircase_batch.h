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
  std::uint32_t side[kSize];   // 0 where a node of tree A is split, else 1

  std::uint32_t cost(std::uint32_t step) const {
    return kSphereUpdateCost + TraversalNode::count(lanes[step]) * kOverlapTestCost;
  }
};

/// For every mask of hits the lanes that are hit, in order, a byte each from the lowest on; the rest is 0. Hits are
/// written down by looking the lanes up: cheaper than compressing vectors, and the same on every instruction set.
struct HitLanes {
  alignas(64) std::uint64_t lanes[256] = {};

  constexpr HitLanes() {
    for (std::uint32_t hits = 0; hits < 256; ++hits)
      for (std::uint64_t lane = 0, found = 0; lane < kFamilyWidth; ++lane)
        if ((hits >> lane & 1U) != 0) lanes[hits] |= lane << 8 * found++;
  }
};
inline constexpr HitLanes kHitLanes;

/// Which of these bytes goes where in eight pairs: into the lowest byte of the first (side 0) or second half of each.
struct LanePlaces {
  static constexpr std::uint8_t kZero = 0x80;  // a byte that becomes 0
  alignas(64) std::uint8_t places[2][kFamilyWidth][8];

  constexpr LanePlaces() : places() {
    for (std::uint32_t side = 0; side < 2; ++side)
      for (std::uint32_t pair = 0; pair < kFamilyWidth; ++pair)
        for (std::uint32_t byte = 0; byte < 8; ++byte)
          places[side][pair][byte] = byte == 4 * side ? static_cast<std::uint8_t>(pair) : kZero;
  }
};
inline constexpr LanePlaces kLanePlaces;

}  // namespace cairn
