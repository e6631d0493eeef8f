// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include <span>
#include <vector>

#include "placement/pair_placement.h"
#include "triangles/side_history.h"
#include "triangles/triangle_touch.h"

namespace cairn::bullet {

/// Decides on which side of each triangle a touching node belongs. +1 is the side of its sphere's centre, -1 the other,
/// where it has sunk through. A node beside a triangle, and in front of the nearest one, cannot have sunk through it.
/// All other nodes are decided by the first of these rules that has an answer:
///
/// 1. where the same node was seen before (`SideHistory`),
/// 2. whether its centre went through the triangle since the last step (`byPath`),
/// 3. where the rest of the body was seen, if the node's centre went through the plane or the centre of mass agrees;
///    else which way the region faces (`byFacing`),
/// 4. where the rest of the body was seen; else where the centre of mass is (`byBody`). The centre of mass counts if
///    the region passes through the triangle or the bodies were never apart.
///
/// No rule suffices alone. A body that hangs has its centre of mass on the wrong side. A region that has sunk deep
/// faces the wrong way. A region in the middle of a thin sheet has no side by itself. So an answer lapses when both the
/// centre of mass and most of the known sides contradict it. A leaf that sank unseen therefore does not keep the body
/// down for ever.
///
///     sides.beginStep(placement);
///     sides.beginTraversal();
///     const std::span<const int> known = sides.settle(tree, triangles, touches, isComplete);
class TriangleSides {
 public:
  /// Forgets all sides and the last poses.
  void reset();
  /// Takes the poses of this step; call it before all else in a step. A body that moved farther than its speed explains
  /// was set down elsewhere, and its history is dropped.
  void beginStep(const PairPlacement& placement);
  void beginTraversal() { seen_.beginTraversal(); }

  /// The sides of `touches`, which are sorted by node and nearest first. `triangles` are those of the pair's obstacle.
  /// If not `isComplete`, some of a node's triangles may be missing, and only the nearest one could decide some
  /// touches. Such touches off a triangle's face get side 0 if the node may have sunk through it or a neighbour. Valid
  /// until the next call.
  std::span<const int> settle(const PlacedTree& tree, std::span<const Triangle> triangles,
                              std::span<const TriangleTouch> touches, bool isComplete);

  /// The side of a bounding sphere: the recorded one, else that of its centre.
  int ofBall(const PlacedTree& tree, const TriangleTouch& touch) const;
  /// Records the side of a bounding sphere.
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
  // Maps a point of the tree to its place in the last step, relative to the other body's present pose.
  btTransform back_;
  std::vector<int> sides_;
};

}  // namespace cairn::bullet
