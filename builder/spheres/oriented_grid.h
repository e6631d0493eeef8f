// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Cubic cells of one size, at any position and orientation.
struct OrientedGrid {
  std::array<Vec3d, 3> axes;  ///< orthonormal, right-handed
  Vec3d corner;               ///< of cell (0, 0, 0)
  double edge = 1;            ///< > 0

  double ballRadius() const { return 0.8660254037844387 * edge; }
};

/// Returns a grid with one cell around all points. Its axes are the principal axes of the points. Its corner is the
/// lowest corner of their box along these axes. Its edge is the longest edge of that box, with a small margin for
/// rounding. Precondition: `points` is not empty.
OrientedGrid principalGrid(std::span<const Vec3d> points);

/// Returns `grid` after a move and a turn. The first three numbers move it along its axes, as fractions of its edge.
/// The other three turn it about `pivot` by angles about its axes (radians).
OrientedGrid moved(const OrientedGrid& grid, const std::array<double, 6>& change, const Vec3d& pivot);

/// The balls around the cells that a greedy choice keeps, most points first, until all points are covered (thesis Alg.
/// 2).
struct GridCover {
  std::vector<Vec3d> centers;
  double metric = 0;  ///< sum of the squares of the numbers of points that each kept ball added (Eq. 3.1)
};

/// Covers the points by balls around the grid's cells. Ties go to the lowest cell. Cost: about 20 cell tests for each
/// point.
GridCover coverByGrid(const OrientedGrid& grid, std::span<const Vec3d> points);

}  // namespace cairn::builder
