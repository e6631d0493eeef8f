// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>
#include <vector>

#include "cairn/core/budget.h"
#include "cairn/core/traversal.h"
#include "placement/placed_tree.h"
#include "triangles/triangle.h"

namespace cairn::bullet {

/// How far the source triangles of two leaves are apart within the leaves' balls, whichever way they face.
class RegionDistance {
 public:
  /// World length by which they are apart at least beyond `margins`, and beyond what rounding can tell; 0 where some
  /// cross or may touch. `normal` (unit, from B to A): a direction in which they may be apart; those that are cost
  /// little. Nothing when the budget does not cover it: 1 operation per triangle, then 2 per triangle that is moved and
  /// 1 per pair.
  std::optional<float> atLeast(const PlacedTree& a, const PlacedTree& b, const NodePair& leaves, const Vec3& normal,
                               float margins, Budget& budget);

 private:
  // A triangle and a ball around it.
  struct Bounded {
    Triangle triangle;
    Sphere ball;
  };
  static float extent(const PlacedTree& tree, NodeId leaf, const Vec3& direction);
  static float place(const PlacedTree& tree, NodeId leaf, const Sphere& other, float near,
                     std::vector<Bounded>& placed);
  static float between(const Bounded& t, const Bounded& u, float near);

  std::vector<Bounded> ofA_, ofB_;
};

}  // namespace cairn::bullet
