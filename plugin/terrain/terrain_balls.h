// SPDX-License-Identifier: Zlib
#pragma once

#include <numbers>

#include "terrain/terrain_lattice.h"

namespace cairn::bullet {

/// The ground around a point of the shape's frame.
struct GroundBelow {
  double height = 0;  ///< of the point over it, negative inside; NaN where there is none
  /// Ground within the radius asked about is no nearer than this times the height; 0 where some is missing there, or
  /// beyond the border.
  double factor = 0;

  bool isInside() const { return height < 0; }
  /// Distance of the ground at least, where it is within that radius; minus infinity where nothing is known.
  double leastDistance() const {
    return height > 0 && factor > 0 ? height * factor : -std::numeric_limits<double>::infinity();
  }
};
/// Constant time.
GroundBelow groundBelow(const TerrainLattice& lattice, const Vec3d& point, double radius);

/// Whether a ball of the shape's frame has points inside the ground or on it. Cost: one cell where the ground below its
/// centre is so near or so far that its steepness decides, else the cells below the ball.
bool touchesGround(const TerrainLattice& lattice, const Vec3d& center, double radius);

namespace detail {
inline bool isPlaneWithin(const TerrainLattice::Corners& t, const Vec3d& center, double radius) {
  const Vec3d normal = t.normal();
  const double distance = dot(normal, center - toVec3d(t.at[0]));
  return distance * distance <= radius * radius * lengthSq(normal);
}
}  // namespace detail

/// Calls `visit(corners, index)` for the triangles below a ball of the shape's frame whose planes it meets: all
/// that come within its radius are among them. `isBelow`: the centre is below ground, and what is above it counts as
/// well, however far.
template <class Visit>
void forEachTriangleNear(const TerrainLattice& lattice, const Vec3d& center, double radius, bool isBelow,
                         const Visit& visit) {
  const auto at = [&](double sign) { return toBullet(center + Vec3d(1, 1, 1) * (sign * radius)); };
  const btVector3 lower = at(-1);
  btVector3 upper = at(1);
  if (isBelow) upper.setZ(std::numeric_limits<btScalar>::infinity());
  // Beside a diagonal by more than its radius, and what coordinates are rounded by, a ball has only one of the cell's
  // triangles below it.
  const double rounding = 4 * double(SIMD_EPSILON) * double(std::max(lattice.xs().back(), lattice.ys().back()));
  const double beside = (radius + rounding) * std::numbers::sqrt2;
  lattice.forEachCell(lower, upper, [&](std::int64_t column, std::int64_t row) {
    const double x = center.x - double(lattice.xs()[static_cast<std::size_t>(column)]);
    const double y = center.y - double(lattice.ys()[static_cast<std::size_t>(row)]);
    const double above = lattice.isRising(column, row) ? y - x : x + y - lattice.grid().cell;
    for (const bool isUpper : {false, true}) {
      TerrainLattice::Corners t;
      if ((isUpper ? above < -beside : above > beside) || !lattice.corners(column, row, isUpper, t)) continue;
      if (isBelow || detail::isPlaneWithin(t, center, radius)) visit(t, lattice.indexOf(column, row, isUpper));
    }
  });
}

}  // namespace cairn::bullet
