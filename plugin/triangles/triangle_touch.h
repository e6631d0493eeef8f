// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/traversal.h"
#include "placement/placed_tree.h"
#include "placement/triangle.h"

namespace cairn::bullet {

/// How a node's sphere stands to a triangle, pair frame.
struct TriangleTouch {
  NodePair pair;
  Vec3 nearest;        ///< on the triangle, to the sphere's centre
  Vec3 line;           ///< unit, from there to the centre; the face's normal where that is the same; zero: degenerate
  Vec3 face;           ///< the triangle's normal, on the centre's side
  float distance = 0;  ///< from `nearest` to the centre
  bool onFace = false;

  /// Whether the centre is over the triangle rather than beside it, where there is no side of it to have sunk to.
  bool isOver() const;
};

TriangleTouch touchOf(const PlacedTree& tree, const Triangle& triangle, const NodePair& pair);

}  // namespace cairn::bullet
