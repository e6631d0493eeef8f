// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Cubic cells of one size in any place and orientation.
struct OrientedGrid {
  std::array<Vec3d, 3> axes;  ///< orthonormal, right-handed
  Vec3d corner;               ///< of cell (0, 0, 0)
  double edge = 1;            ///< > 0

  double ballRadius() const { return 0.8660254037844387 * edge; }
};

/// One cell of each box that holds the points exactly: axes are the principal axes of the points, the corner the box's
/// lowest, the edge its longest edge, with a little room for rounding. Precondition: `points` not empty.
OrientedGrid principalGrid(std::span<const Vec3d> points);

/// `grid` moved by three parts of its edge along its axes, then turned about `pivot` by three angles about them.
OrientedGrid moved(const OrientedGrid& grid, const std::array<double, 6>& change, const Vec3d& pivot);

/// The balls around cells that a greedy choice keeps, most points first until all are covered (thesis Alg. 2).
struct GridCover {
  std::vector<Vec3d> centers;
  double metric = 0;  ///< sum of the squares of the points each kept ball added, Eq. 3.1
};

/// Considers the cells whose balls hold a point. Ties go to the lowest cell. About 20 cell tests for each point.
GridCover coverByGrid(const OrientedGrid& grid, std::span<const Vec3d> points);

}  // namespace cairn::builder
