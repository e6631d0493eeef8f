// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/sphere_tree.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// A surface near a node of the tree, pair frame: a point of it, and its normal towards the side of the node.
struct SurfaceSide {
  Vec3 point;
  Vec3 normal;
};

/// Remembers on which sides of a surface the nodes of a tree were last seen. A triangle has no inside: a node that has
/// sunk through it looks like one behind it. Only its earlier place tells the two apart. Sides are kept as planes, so
/// that they carry over from triangle to triangle.
///
///     history.beginStep(carry);
///     const int side = history.ofNode(node, surface, tolerance);
///     history.note(node, surface);
///
/// An answer is +1 for the side to which the given normal points, -1 for the other side of its triangle, 0 for unknown.
class SideHistory {
 public:
  /// Forgets everything.
  void reset();
  /// Begins a step. `carry(SurfaceSide&)` moves a plane along with the collider. Witnesses of the last step are
  /// dropped.
  void beginStep(const auto& carry) {
    for (Side& side : sides_) carry(side.plane);
    witnesses_.clear();
    count();
  }
  /// Begins a traversal. Drops sides that the traversal before it has not seen.
  void beginTraversal();
  /// Whether this is the first traversal since `reset`.
  bool isFirst() const { return traversal_ <= 1; }

  /// The side of a node, by any of its planes within 60 degrees of this one; +1 wins over -1. A surface in front of a
  /// known plane by more than `tolerance` has not been sunk through: the floor below a ceiling.
  int ofNode(NodeId node, const SurfaceSide& surface, float tolerance) const;
  /// Whether the point is behind a plane that the node belongs in front of.
  bool isBehind(NodeId node, const Vec3& point) const;
  /// The side on which any node was seen in this step, for surfaces within 25 degrees and `tolerance` of this one. It
  /// is 0 also when nodes were seen on both sides.
  int ofTree(const SurfaceSide& surface, float tolerance) const;
  /// Whether at least three times as many sides known before this step point against the direction as along it.
  bool isOutvoted(const Vec3& direction) const;

  /// Records a node's side, in place of its sides within 60 degrees. All functions but `isOutvoted` use it after
  /// `endNotes`.
  void note(NodeId node, const SurfaceSide& side);
  /// Ends a group of notes. They come from leaves at their triangles, and so also serve as witnesses for neighbours.
  void endNotes();
  /// Records a side at once, for a guess that is no witness for others.
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
