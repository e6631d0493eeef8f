// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "spheres/ball.h"
#include "spheres/octants.h"
#include "spheres/piece.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// The part of the surface one node of the tree answers for, mesh frame.
struct Region {
  Ball ball;         ///< holds all pieces
  double error = 0;  ///< certified protrusion of the ball, see certify/protrusion.h
  Pieces pieces;     ///< not empty; the regions of a node's children cover exactly what the node's region covers
  Cube cube;         ///< of the octree; unused by the other methods
};

/// Certified protrusion of a ball.
double errorOf(const Ball& ball, const SignedDistance& solid);

/// The region of these pieces with the better of two balls around it: the one it was given to, and one fitted to it
/// (thesis Alg. 9). Precondition: `pieces` not empty.
Region fittedRegion(const Ball& ball, Pieces pieces, const SignedDistance& solid);

}  // namespace cairn::builder
