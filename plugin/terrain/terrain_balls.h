// SPDX-License-Identifier: Zlib
#pragma once

#include "terrain/terrain_lattice.h"

namespace cairn::bullet {

/// Whether a point of the shape's frame has ground above it: then it is inside, however deep.
bool isBelowGround(const TerrainLattice& lattice, const Vec3d& point);

/// Whether a ball of the shape's frame has points inside the ground or on it. Cost: the cells below the ball until one
/// touches, of blocks whose heights are near it; one where its centre is below the surface or no higher above than its
/// radius.
bool touchesGround(const TerrainLattice& lattice, const Vec3d& center, double radius);

/// Calls `visit(corners, index)` for the triangles of the cells below a ball of the shape's frame: all that come
/// within its radius are among them. `isBelow`: the centre is below ground, and what is above it counts as well,
/// however far.
template <class Visit>
void forEachTriangleNear(const TerrainLattice& lattice, const Vec3d& center, double radius, bool isBelow,
                         const Visit& visit) {
  const auto at = [&](double sign) { return toBullet(center + Vec3d(1, 1, 1) * (sign * radius)); };
  const btVector3 lower = at(-1);
  btVector3 upper = at(1);
  if (isBelow) upper.setZ(std::numeric_limits<btScalar>::infinity());
  lattice.forEachCell(lower, upper, [&](std::int64_t column, std::int64_t row) {
    if (!lattice.cellBounds(column, row).touches(lower.z(), upper.z())) return;
    for (const bool isUpper : {false, true}) {
      TerrainLattice::Corners corners;
      if (lattice.corners(column, row, isUpper, corners)) visit(corners, lattice.indexOf(column, row, isUpper));
    }
  });
}

}  // namespace cairn::bullet
