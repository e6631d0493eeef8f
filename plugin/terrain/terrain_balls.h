// SPDX-License-Identifier: Zlib
#pragma once

#include <numbers>

#include "terrain/terrain_lattice.h"

namespace cairn::bullet {

/// The ground around a point of the shape's frame.
struct GroundBelow {
  double height = 0;  ///< of the point over the ground, negative inside; NaN without ground
  /// Ground within the queried radius is at least this factor times the height away. It is 0 where ground is missing
  /// within the radius, or beyond the border.
  double factor = 0;

  bool isInside() const { return height < 0; }
  /// Lower bound on the distance of ground that lies within the queried radius; minus infinity if unknown.
  double leastDistance() const {
    return height > 0 && factor > 0 ? height * factor : -std::numeric_limits<double>::infinity();
  }
};
/// The ground around `point`; `radius` limits where the bound holds. Constant time.
GroundBelow groundBelow(const TerrainLattice& lattice, const Vec3d& point, double radius);

/// Whether a ball (shape's frame) has points inside the ground or on it. Cost: one cell where the height over the
/// ground and the slopes decide, else the cells below the ball.
bool touchesGround(const TerrainLattice& lattice, const Vec3d& center, double radius);

namespace detail {
/// Whether the plane of a triangle is within `radius` of the centre.
inline bool isPlaneWithin(const TerrainLattice::Corners& t, const Vec3d& center, double radius) {
  const Vec3d normal = t.normal();
  const double distance = dot(normal, center - toVec3d(t.at[0]));
  return distance * distance <= radius * radius * lengthSq(normal);
}
}  // namespace detail

/// Calls `visit(corners, index)` for the triangles below a ball (shape's frame) whose planes meet it. These include all
/// triangles within its radius. `isBelow`: the centre is below ground, and all triangles above it count too, at any
/// distance.
template <class Visit>
void forEachTriangleNear(const TerrainLattice& lattice, const Vec3d& center, double radius, bool isBelow,
                         const Visit& visit) {
  const auto at = [&](double sign) { return toBullet(center + Vec3d(1, 1, 1) * (sign * radius)); };
  const btVector3 lower = at(-1);
  btVector3 upper = at(1);
  if (isBelow) upper.setZ(std::numeric_limits<btScalar>::infinity());
  // A ball farther beside a diagonal than its radius, plus rounding of coordinates, has only one of the cell's
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
