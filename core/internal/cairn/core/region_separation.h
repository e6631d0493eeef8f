// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>

#include "cairn/core/export.h"

#include "cairn/core/pair_list.h"
#include "cairn/core/pose.h"
#include "cairn/core/sphere_tree.h"

namespace cairn {

/// The regions of a sphere-tree's nodes seen from the pair frame. Everything referred to must outlive this.
struct PlacedRegions {
  const SphereTree& tree;    ///< whose regions these are
  const Similarity& toPair;  ///< from the tree's frame to the pair frame
  const Mat3& axesFromPair;  ///< rotation from the pair frame's axes to the tree's

  /// The node's ball in the pair frame.
  Sphere sphere(NodeId node) const {
    const Sphere s = tree.sphere(node);
    return {toPair * s.center, s.radius * toPair.scale};
  }
  /// The region's support point that lies farthest along `direction` (pair frame).
  Vec3 support(NodeId node, const Vec3& direction) const {
    const SupportBlock& block = tree.support(node);
    return toPair * block.point(supportLane(block, axesFromPair * direction));
  }
};

/// Which gaps between two regions are of interest; lengths of the pair frame.
struct SeparationLimits {
  float margins = 0;  ///< grow the two surfaces together, and so shrink every gap
  float atMost = 0;   ///< of a gap that is not below it, nothing but that need be found out
  float reach = 0;    ///< separations from here on are no contacts
};

/// How far two regions are apart along a direction; in the pair frame.
struct RegionSeparation {
  float separation = 0;  ///< between the support points; where it is not below `atMost`, that or some lower bound of it
  Vec3 position;         ///< half-way between the nearest points; set where `isNear`
  bool isNear = false;   ///< the gap is below both limits
};

/// Separation of two nodes, a's and b's, along `normal` (unit, from b to a). Two support points, some 200 cycles.
CAIRN_CORE_EXPORT
RegionSeparation measureSeparation(const PlacedRegions& a, const PlacedRegions& b, const NodePair& pair,
                                   const Vec3& normal, const SeparationLimits& limits);

/// The gaps of up to sixteen pairs, each along the line of its spheres' centres, in the pair frame; structure of
/// arrays.
struct alignas(64) RegionSeparations {
  /// Pairs at most.
  static constexpr std::uint32_t kSize = 16;

  float normalX[kSize], normalY[kSize], normalZ[kSize];  ///< unit, from b to a
  float separation[kSize];                               ///< as `RegionSeparation::separation`
  float x[kSize], y[kSize], z[kSize];                    ///< as `RegionSeparation::position`
  /// A bit for each pair that `measureSeparation` would call near.
  std::uint32_t nearPairs = 0;
  /// Pairs whose centres are so near each other (less than 1e-19) that their line says too little in floats: their
  /// numbers mean nothing, and they are not near.
  std::uint32_t blurredPairs = 0;

  /// The direction along which pair `i` was measured, unit, from b to a.
  Vec3 normal(std::uint32_t i) const { return {normalX[i], normalY[i], normalZ[i]}; }
  /// Where the regions of pair `i` are nearest, in the pair frame.
  Vec3 position(std::uint32_t i) const { return {x[i], y[i], z[i]}; }
};

/// Fills in the first `pairs.size()` lanes of `separations`; no bits are set for others. The same bits as
/// `measureSeparation` along `line / length(line)` on every instruction set, in a third of the time a pair.
/// Precondition: one to sixteen pairs.
CAIRN_CORE_EXPORT
void measureSeparations(const PlacedRegions& a, const PlacedRegions& b, std::span<const NodePair> pairs,
                        const SeparationLimits& limits, RegionSeparations& separations);

}  // namespace cairn
