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

/// The part of the surface that one node of the tree covers. Mesh frame.
struct Region {
  Ball ball;            ///< holds all pieces
  double error = 0;     ///< certified protrusion of the ball, see certify/protrusion.h
  Pieces pieces;        ///< the regions of a node's children cover exactly the same area; empty only inside the solid
  Cube cube{};          ///< for octrees; unused by the other methods
  bool filled = false;  ///< the ball also holds the cube (solid octree)
  std::vector<std::uint32_t>
      medial{};  ///< Hubbard's medial spheres that were merged into the ball; unused by the other methods
};

/// Returns the certified protrusion of a ball, mesh unit.
double errorOf(const Ball& ball, const SignedDistance& solid);

/// Returns the region of these pieces with a ball around it. `refit` selects the ball's centre: the given one, or one
/// fitted to the pieces (thesis Alg. 8). The search ends early once the error exceeds `ofInterest`; the error is then
/// only known to be larger. Precondition: `pieces` is not empty.
Region fittedRegion(const Ball& ball, Pieces pieces, const SignedDistance& solid, Refit refit = Refit::tightest,
                    double ofInterest = std::numeric_limits<double>::infinity());

}  // namespace cairn::builder
