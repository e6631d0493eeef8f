// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "balls/piece.h"
#include "cairn/builder/ball.h"
#include "regions/method_traits.h"
#include "spheres/octants.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// The part of the surface one node of the tree answers for, mesh frame.
struct Region {
  Ball ball;         ///< holds all pieces
  double error = 0;  ///< certified protrusion of the ball, see certify/protrusion.h
  Pieces pieces;  ///< the regions of a node's children cover exactly what its own covers; empty only inside the solid
  Cube cube{};    ///< of the octrees; unused by the other methods
  bool filled = false;                  ///< the ball holds the cube as well (solid octree)
  std::vector<std::uint32_t> medial{};  ///< Hubbard's medial spheres merged into the ball; unused by the other methods
};

/// Certified protrusion of a ball.
double errorOf(const Ball& ball, const SignedDistance& solid);

/// The region of these pieces with a ball around it: the centre it was given to, or one fitted to it, as `refit` says
/// (thesis Alg. 8). An error above `ofInterest` is only known to be that, which is found out sooner. Precondition:
/// `pieces` not empty.
Region fittedRegion(const Ball& ball, Pieces pieces, const SignedDistance& solid, Refit refit = Refit::tightest,
                    double ofInterest = std::numeric_limits<double>::infinity());

}  // namespace cairn::builder
