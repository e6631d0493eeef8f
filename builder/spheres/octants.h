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

/// One of eight: bit 0 of `which` is the side in x, bit 1 in y, bit 2 in z.
Cube octantOf(const Cube& cube, unsigned which);
/// Its corner `which`, numbered alike.
Vec3d cornerOf(const Cube& cube, unsigned which);

/// The smallest cube around the middle of the box that holds it.
Cube cubeAround(const Bounds& bounds);

struct Octant {
  Cube cube;
  Pieces pieces;
};

/// The octree reduction (thesis 3.1): up to eight octants of `cube` that hold surface, each with the pieces the ball
/// around it answers for. A piece belongs where its centroid lies; one that sticks out of the octant's ball is bisected
/// first, down to a longest edge of `finest`. A cube with all its surface in one octant is replaced by that octant, so
/// the result has at least two parts unless the surface cannot be told apart at all. Precondition: the cube holds the
/// pieces, `finest` > 0.
std::vector<Octant> divideByOctants(const Pieces& pieces, Cube cube, double finest);

}  // namespace cairn::builder
