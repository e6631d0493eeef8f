// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/traversal.h"
#include "placement/placed_tree.h"
#include "placement/triangle.h"

namespace cairn::bullet {

/// The relation of a node's sphere to a triangle, pair frame.
struct TriangleTouch {
  NodePair pair;
  Vec3 nearest;  ///< on the triangle, to the sphere's centre
  /// Unit, from `nearest` to the centre; the face's normal if the two coincide; zero for a degenerate triangle.
  Vec3 line;
  Vec3 face;           ///< the triangle's normal, on the centre's side
  float distance = 0;  ///< from `nearest` to the centre
  bool onFace = false;

  /// Whether the centre is over the triangle and not beside it; beside it there is no side to sink to.
  bool isOver() const;
};

/// Measures the sphere of the pair's node a against `triangle`, its b, in the pair frame. Constant time.
TriangleTouch touchOf(const PlacedTree& tree, const Triangle& triangle, const NodePair& pair);

}  // namespace cairn::bullet
