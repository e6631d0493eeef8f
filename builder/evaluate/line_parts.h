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

/// Parts of one line, ascending and apart.
using LineParts = std::vector<LinePart>;

/// Where lines parallel to the z axis run inside a solid. Lines that meet an edge or a corner of the projected mesh
/// need no special case: every edge decides on which side of itself a line passes once for both of its triangles, so
/// the entries and exits of a line always add up to zero.
class SolidLines {
 public:
  /// Keeps a reference to `mesh`, which must outlive this. Precondition: `checkMesh(mesh)`. O(n).
  explicit SolidLines(const TriangleMesh& mesh);

  /// The parts of the line through (x, y, 0) inside the solid, replacing `out`.
  void partsAt(double x, double y, LineParts& out) const;
  const Rectangle& bounds() const { return buckets_.bounds(); }

 private:
  struct Crossing {
    double z = 0;
    int entries = 0;  // 1 into the solid going up, -1 out of it
  };
  Crossing crossingOf(std::uint32_t triangle, double x, double y) const;

  const TriangleMesh& mesh_;
  PlaneBuckets buckets_;
};

/// Where lines parallel to the z axis run inside a union of balls.
class BallLines {
 public:
  /// Keeps a reference to `balls`, which must outlive this. O(n).
  explicit BallLines(const std::vector<CutBall>& balls);

  void partsAt(double x, double y, LineParts& out) const;
  const Rectangle& bounds() const { return buckets_.bounds(); }

 private:
  const std::vector<CutBall>& balls_;
  PlaneBuckets buckets_;
};

/// The parts of `from` that lie in no part of `what`, replacing `out`. Linear time.
void subtract(const LineParts& from, const LineParts& what, LineParts& out);

}  // namespace cairn::builder
