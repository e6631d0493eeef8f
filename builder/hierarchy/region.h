// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "spheres/ball.h"
#include "spheres/octants.h"
#include "spheres/piece.h"

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

}  // namespace cairn::builder
