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
  /// What is asked about two leaves, pair frame.
  struct Question {
    Vec3 normal;           ///< unit, from B to A: a direction in which they may be apart; those that are cost little
    float margins = 0;     ///< world length: nearer than that they touch
    float ofInterest = 0;  ///< world length: by how much more they are apart does not matter
  };
  /// World length by which they are apart beyond the margins and what rounding can tell, or some bound of it above
  /// `ofInterest`; 0 where some cross or may touch. Nothing when the budget does not cover it: 1 operation per
  /// triangle, then 2 per triangle that is moved and 1 per pair.
  std::optional<float> atLeast(const PlacedTree& a, const PlacedTree& b, const NodePair& leaves,
                               const Question& question, Budget& budget);

 private:
  // A triangle and a ball around it.
  struct Bounded {
    Triangle triangle;
    Sphere ball;
  };
  static float extent(const PlacedTree& tree, NodeId leaf, const Vec3& direction);
  static float place(const PlacedTree& tree, NodeId leaf, const Sphere& other, float ofInterest,
                     std::vector<Bounded>& placed);
  static float between(const Bounded& t, const Bounded& u, float near, float ofInterest);

  std::vector<Bounded> ofA_, ofB_;
};

}  // namespace cairn::bullet
