// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "counterparts/counterpart.h"
#include "counterparts/touched_sides.h"
#include "counterparts/triangle_touch.h"

namespace cairn::bullet {

/// Tells on which side of each triangle what touches it belongs: +1 on the side its sphere's centre is on, -1 on the
/// other, where it has sunk through. Told, in this order, by
/// 1. where the same node was seen before,
/// 2. whether its centre went through the triangle in the last step (or through its plane, as others went through its
///    neighbours),
/// 3. where the rest of the body was seen, if its centre of mass is there too,
/// 4. which way the region faces: it touches what it faces,
/// 5. where the rest of the body was seen,
/// 6. where the centre of mass is, if the region reaches through the triangle or the bodies were never apart.
/// What a body hangs by has its centre of mass on the wrong side, what has sunk deep faces the wrong way, and what is
/// in the middle of a thin sheet says nothing by itself: none of them suffices alone.
class TriangleSides {
 public:
  void reset() { seen_.reset(); }
  void beginStep() { seen_.beginStep(); }
  void beginTraversal() { seen_.beginTraversal(); }

  /// The sides of `touches`, which are ordered by node and nearest first; valid until the next call. `triangles` are
  /// those of the pair's obstacle. Unless `isComplete`, what a node touches may be missing: then 0 is the side of what
  /// stands beside a triangle and may have sunk through a neighbour of it.
  std::span<const int> settle(const PairPlacement& placement, std::span<const Triangle> triangles,
                              std::span<const TriangleTouch> touches, bool isComplete);

  /// The side of a bounding sphere: where it was seen, else where anything was.
  int ofBall(const PlacedTree& tree, const TriangleTouch& touch) const;
  void noteBall(const TriangleTouch& touch, const Vec3& direction);

 private:
  void settle(std::span<const TriangleTouch> touches, const auto& sideOf);
  int ofTree(const PlacedTree& tree, const TriangleTouch& touch) const;
  int byPath(const PlacedTree& tree, const Triangle& triangle, const TriangleTouch& touch) const;
  int byFacing(const PlacedTree& tree, const TriangleTouch& touch) const;
  int byBody(const PlacedTree& tree, const TriangleTouch& touch) const;
  void dropUncovered(const PlacedTree& tree, std::span<const TriangleTouch> touches);
  bool hasPassed(const PlacedTree& tree, const TriangleTouch& touch) const;

  TouchedSides seen_;
  Similarity back_;  // one step, see `RelativeMotion`
  std::vector<int> sides_;
};

}  // namespace cairn::bullet
