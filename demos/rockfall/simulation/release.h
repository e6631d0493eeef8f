// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <LinearMath/btTransform.h>

#include <cstdint>
#include <vector>

#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// A rock as a run begins it.
struct ReleasedRock {
  std::uint32_t group = 0, variant = 0;
  double sieveM = 0, massKg = 0;
  double reachM = 0;  ///< of its farthest point from the centre of mass
  double timeS = 0;
  btTransform pose;
  btVector3 velocity;
};

/// All rocks of a run, by group and number: a pure function of (scene, run). Centres lie `above_ground_m` higher than
/// where a ball of the rock's reach would touch the plane of the ground below it; rocks released within two seconds of
/// each other do not overlap: whoever finds no free place in the box in 20 draws starts higher. Cost: quadratic in the
/// rocks.
std::vector<ReleasedRock> releaseRocks(const Scene& scene, std::uint64_t run);

}  // namespace cairn::rockfall
