// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include <span>
#include <vector>

#include "placement/pair_placement.h"
#include "triangles/side_history.h"
#include "triangles/triangle_touch.h"

namespace cairn::bullet {

/// Tells on which side of each triangle what touches it belongs: +1 on the side its sphere's centre is on, -1 on the
/// other, where it has sunk through. Beside a triangle, and in front of the nearest one, there is nothing to have sunk
/// through. For the rest it is told, in this order, by
/// 1. where the same node was seen before (`SideHistory`),
/// 2. whether its centre went through the triangle since the last step: `byPath`,
/// 3. where the rest of the body is seen, if the centre went through the triangle's plane or the centre of mass is
///    there too; else which way the region faces, as it touches what it faces: `byFacing`,
/// 4. where the rest of the body is seen; else where the centre of mass is, if the region reaches through the triangle
///    or the bodies were never apart: `byBody`.
/// What a body hangs by has its centre of mass on the wrong side, what has sunk deep faces the wrong way, and what is
/// in the middle of a thin sheet says nothing by itself: none of them suffices alone. So an answer that the centre of
/// mass contradicts lapses when most of what was seen contradicts it as well: a leaf that sank unseen does not keep the
/// body down for ever.
class TriangleSides {
 public:
  void reset();
  /// Takes the poses of this step, before all else in it. A body that moved farther than its speed explains was set
  /// down: it has no past.
  void beginStep(const PairPlacement& placement);
  void beginTraversal() { seen_.beginTraversal(); }

  /// The sides of `touches`, which are ordered by node and nearest first; valid until the next call. `triangles` are
  /// those of the pair's obstacle. Unless `isComplete`, what a node touches may be missing: then 0 is the side of what
  /// is off a triangle's face and may have sunk, through it or a neighbour: only the nearest triangle could tell.
  std::span<const int> settle(const PlacedTree& tree, std::span<const Triangle> triangles,
                              std::span<const TriangleTouch> touches, bool isComplete);

  /// The side of a bounding sphere: where it was noted, else where it is.
  int ofBall(const PlacedTree& tree, const TriangleTouch& touch) const;
  /// Notes where a bounding sphere stands.
  void noteBall(const TriangleTouch& touch, const Vec3& normal);

 private:
  void settleBy(const PlacedTree& tree, std::span<const TriangleTouch> touches, const auto& sideOf);
  int ofTree(const PlacedTree& tree, const TriangleTouch& touch) const;
  int ofNode(const PlacedTree& tree, const TriangleTouch& touch) const;
  int byPath(const PlacedTree& tree, const Triangle& triangle, const TriangleTouch& touch) const;
  int byFacing(const PlacedTree& tree, const TriangleTouch& touch) const;
  int byBody(const PlacedTree& tree, const TriangleTouch& touch) const;
  void dropUncovered(const PlacedTree& tree, std::span<const TriangleTouch> touches);
  Vec3 centerBefore(const PlacedTree& tree, NodeId node) const;

  SideHistory seen_;
  bool hasPast_ = false;
  btTransform treeBody_, other_;  // of this step, as in the placement
  btTransform back_;  // takes a point of the tree to where it was in the last step, as seen from where the other is now
  std::vector<int> sides_;
};

}  // namespace cairn::bullet
