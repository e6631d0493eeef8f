// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <vector>

#include "simulation/simulation.h"

namespace cairn::simulation {

/// A contact point that the last step gave to the solver.
struct Contact {
  btVector3 point;         ///< on body b, world
  btVector3 normal;        ///< unit, from b to a, world
  float depth = 0;         ///< m; negative where the surfaces are apart
  float error = 0;         ///< certified, m, of the pair: how far surfaces may be from where its contacts put them
  float impulse = 0;       ///< along the normal, N s
  int a = 0, b = 0;        ///< numbers; planes and boxes are negative
  bool isResolved = true;  ///< the pair was finished in the last step
};

/// The contacts of the last step, in the order of Bullet's manifolds; `contacts` is emptied first.
void listContacts(const Simulation& simulation, std::vector<Contact>& contacts);

}  // namespace cairn::simulation
