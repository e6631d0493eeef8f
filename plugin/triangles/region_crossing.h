// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>
#include <vector>

#include "cairn/core/budget.h"
#include "cairn/core/traversal.h"
#include "placement/placed_tree.h"
#include "triangles/triangle.h"

namespace cairn::bullet {

/// Whether the source triangles of two leaves overlap within the leaves' balls, whichever way they face.
class RegionCrossing {
 public:
  /// Whether some cross, or come within `margins` (world length) and what rounding can tell of each other. `normal`
  /// (unit, from B to A): a direction in which they may be apart; those that are cost little. Nothing when the budget
  /// does not cover it: 1 operation per triangle, then 2 per triangle that is moved and 1 per pair.
  std::optional<bool> between(const PlacedTree& a, const PlacedTree& b, const NodePair& leaves, const Vec3& normal,
                              float margins, Budget& budget);

 private:
  // A triangle and a ball around it.
  struct Bounded {
    Triangle triangle;
    Sphere ball;
  };
  static float extent(const PlacedTree& tree, NodeId leaf, const Vec3& direction);
  static void place(const PlacedTree& tree, NodeId leaf, const Sphere& within, std::vector<Bounded>& placed);
  static bool meet(const Bounded& t, const Bounded& u, float margins);

  std::vector<Bounded> ofA_, ofB_;
};

}  // namespace cairn::bullet
