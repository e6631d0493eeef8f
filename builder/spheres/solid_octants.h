// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "spheres/octants.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

struct SolidOctants {
  std::vector<Octant> surface;  ///< each with all pieces that meet it; a piece may be in several octants
  std::vector<Cube> inside;     ///< octants without surface, inside the solid; they need no division
};

/// The solid octree (thesis 3.1.2): the octants of `cube` that hold surface, and those that lie inside the solid. The
/// surface in the cube is kept. Parts of `pieces` outside the cube may be left to the cube they lie in. The cube
/// decides, not the ball around it, whose caps may stick out. A piece that sticks out of the ball of an octant it meets
/// is bisected first, down to a longest edge of `finest`. A cube whose only octant has surface is replaced by that
/// octant. So there are at least two parts, unless the surface cannot be separated.
///
/// Preconditions: `pieces` is all surface that meets the cube, `finest` > 0. Cost: a distance query for each octant.
SolidOctants divideSolid(const Pieces& pieces, Cube cube, double finest, const SignedDistance& solid);

}  // namespace cairn::builder
