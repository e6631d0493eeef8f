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
  Pieces pieces;     ///< not empty; the regions of a node's children cover exactly what the node's region covers
  Cube cube{};       ///< of the octree; unused by the other methods
  std::vector<std::uint32_t> medial{};  ///< Hubbard's medial spheres merged into the ball; unused by the other methods
};

}  // namespace cairn::builder
