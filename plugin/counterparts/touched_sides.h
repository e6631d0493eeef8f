// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/sphere_tree.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// On which sides of a surface the nodes of a tree were last seen. A triangle has no inside: what has sunk through it
/// looks like what lies behind it, and only where it was before tells one from the other. Sides are kept as directions
/// (unit, world axes, towards where the node belongs), so that they carry over from triangle to triangle.
///
/// A side is +1 where a normal points, -1 on the other side of its triangle, 0 when nothing is known.
class TouchedSides {
 public:
  /// Forgets all.
  void reset();
  /// The bodies have moved: points noted before are no longer where they were.
  void beginStep() { planes_.clear(); }
  /// A new traversal begins. What the one before it has not seen is forgotten.
  void beginTraversal();
  /// Whether no traversal ended before this one.
  bool isFirst() const { return traversal_ <= 1; }

  /// Where the node was seen, by whichever of its directions lies nearest to the normal's line, within 60 degrees.
  int ofNode(NodeId node, const Vec3& normal) const;
  /// Where anything of the tree was seen in this step, of surfaces within 25 degrees of the normal's line that the
  /// point is no farther than `tolerance` from (their planes): 0 also when it was seen on both sides.
  int ofTree(const Vec3& normal, const Vec3& point, float tolerance) const;

  /// Notes where a node belongs, instead of what it had within 60 degrees: in the direction, seen from the point of the
  /// surface. `ofNode` and `ofTree` know it after `endNotes`.
  void note(NodeId node, const Vec3& direction, const Vec3& point);
  void endNotes();

 private:
  struct Side {
    NodeId node = 0;
    Vec3 direction;
    std::uint32_t seen = 0;  // the traversal
  };
  struct Plane {
    Vec3 normal;
    Vec3 point;
  };

  static bool byNode(const Side& x, const Side& y) { return x.node < y.node; }
  void hold(const Side& note);
  void hold(const Plane& plane);

  std::vector<Side> sides_;  // by node
  std::vector<Side> notes_;  // since the last `endNotes`
  std::vector<Vec3> notedPoints_;
  std::vector<Plane> planes_;  // of this step, no two alike
  std::uint32_t traversal_ = 0;
};

}  // namespace cairn::bullet
