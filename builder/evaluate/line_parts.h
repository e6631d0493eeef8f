// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "evaluate/cut_ball.h"
#include "evaluate/plane_buckets.h"

namespace cairn::builder {

/// A part of a line parallel to the z axis, in mesh units.
struct LinePart {
  double begin = 0, end = 0;  ///< z; begin <= end
};

/// Disjoint parts of one line, in ascending order.
using LineParts = std::vector<LinePart>;

/// The parts of lines parallel to the z axis that lie inside a solid. Lines that meet an edge or a corner of the
/// projected mesh need no special case. Every edge decides once, for both of its triangles, on which side a line
/// passes. So the entries and exits of a line always add up to zero.
class SolidLines {
 public:
  /// Keeps a reference to `mesh`, which must outlive this object. Precondition: `checkMesh(mesh)`. O(n).
  explicit SolidLines(const TriangleMesh& mesh);

  /// Replaces `out` by the parts inside the solid of the line through (x, y, 0).
  void partsAt(double x, double y, LineParts& out) const;
  const Rectangle& bounds() const { return buckets_.bounds(); }

 private:
  struct Crossing {
    double z = 0;
    int entries = 0;  // 1: into the solid on the way up, -1: out of it
  };
  Crossing crossingOf(std::uint32_t triangle, double x, double y) const;

  const TriangleMesh& mesh_;
  PlaneBuckets buckets_;
};

/// The parts of lines parallel to the z axis that lie inside a union of balls.
class BallLines {
 public:
  /// Keeps a reference to `balls`, which must outlive this object. O(n).
  explicit BallLines(const std::vector<CutBall>& balls);

  void partsAt(double x, double y, LineParts& out) const;
  const Rectangle& bounds() const { return buckets_.bounds(); }

 private:
  const std::vector<CutBall>& balls_;
  PlaneBuckets buckets_;
};

/// Replaces `out` by the parts of `from` that lie in no part of `what`. Linear time.
void subtract(const LineParts& from, const LineParts& what, LineParts& out);

}  // namespace cairn::builder
