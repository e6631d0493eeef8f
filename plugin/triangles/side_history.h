// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/sphere_tree.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// A surface near a node of the tree, pair frame: a point of it, and its normal towards where the node belongs.
struct SurfaceSide {
  Vec3 point;
  Vec3 normal;
};

/// On which sides of a surface the nodes of a tree were last seen. A triangle has no inside: what has sunk through it
/// looks like what lies behind it, and only where it was before tells one from the other. Sides are kept as planes, so
/// that they carry over from triangle to triangle.
///
/// An answer is +1 where the normal asked about points, -1 on the other side of its triangle, 0 when nothing is known.
class SideHistory {
 public:
  /// Forgets all.
  void reset();
  /// The bodies have moved: `carry(SurfaceSide&)` takes a plane along with the collider. What was seen in the last
  /// step is no witness any more.
  void beginStep(const auto& carry) {
    for (Side& side : sides_) carry(side.plane);
    witnesses_.clear();
    count();
  }
  /// A new traversal begins. What the one before it has not seen is forgotten.
  void beginTraversal();
  /// Whether this is the first traversal since `reset`.
  bool isFirst() const { return traversal_ <= 1; }

  /// Where the node was seen, by whichever of its planes lies within 60 degrees of this one; +1 before -1. What lies
  /// before a plane that the node was seen in front of (by more than `tolerance`) has not been sunk through: the floor
  /// below a ceiling.
  int ofNode(NodeId node, const SurfaceSide& surface, float tolerance) const;
  /// Whether the point is behind a plane that the node belongs in front of.
  bool isBehind(NodeId node, const Vec3& point) const;
  /// Where anything of the tree was seen in this step, of surfaces within 25 degrees and `tolerance` of this one: 0
  /// also when it was seen on both sides.
  int ofTree(const SurfaceSide& surface, float tolerance) const;
  /// Whether of what the tree had seen before this step at least three times as much belongs against the direction as
  /// along it.
  bool isOutvoted(const Vec3& direction) const;

  /// Notes where a node belongs, instead of what it had within 60 degrees. Known to all questions but `isOutvoted`
  /// after `endNotes`.
  void note(NodeId node, const SurfaceSide& side);
  /// Notes are of leaves at their triangles, and so tell about their neighbours.
  void endNotes();
  /// The same at once, of a guess that tells about nothing else.
  void noteAlone(NodeId node, const SurfaceSide& side) { hold({node, side, traversal_}); }

 private:
  struct Side {
    NodeId node = 0;
    SurfaceSide plane;
    std::uint32_t seen = 0;  // the traversal
  };
  struct Votes {
    Vec3 direction;
    std::uint32_t count;
  };

  static bool byNode(const Side& x, const Side& y) { return x.node < y.node; }
  void hold(const Side& note);
  void witness(const SurfaceSide& plane);
  void count();

  std::vector<Side> sides_;             // by node
  std::vector<Side> notes_;             // since the last `endNotes`
  std::vector<SurfaceSide> witnesses_;  // planes of this step, each direction once in a place
  std::vector<Votes> votes_;            // of `sides_` when the step began
  std::uint32_t traversal_ = 0;
};

}  // namespace cairn::bullet
