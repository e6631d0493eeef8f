// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <vector>

#include "balls/piece.h"
#include "cairn/builder/ball.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

struct Cube {
  Vec3d center;
  double halfEdge = 0;

  double circumradius() const { return std::numbers::sqrt3 * halfEdge; }
};

/// Returns one of the eight octants of a cube. Bit 0 of `which` selects the side in x, bit 1 in y, bit 2 in z.
Cube octantOf(const Cube& cube, unsigned which);
/// Returns corner `which` of the cube, with the bits of `octantOf`.
Vec3d cornerOf(const Cube& cube, unsigned which);

/// Returns the smallest cube with the box's centre that holds the box.
Cube cubeAround(const Bounds& bounds);

struct Octant {
  Cube cube;
  Pieces pieces;
};

/// The octree reduction (thesis 3.1): up to eight octants of `cube` that hold surface, each with the pieces that its
/// ball must hold. A piece belongs to the octant of its centroid. A piece that sticks out of the octant's ball is
/// bisected first, down to a longest edge of `finest`. A cube with all its surface in one octant is replaced by that
/// octant. So there are at least two parts, unless the surface cannot be separated at all. Preconditions: the cube
/// holds the pieces, `finest` > 0.
std::vector<Octant> divideByOctants(const Pieces& pieces, Cube cube, double finest);

}  // namespace cairn::builder
