// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <LinearMath/btTransform.h>

#include <cstdint>
#include <vector>

#include "rockfall/simulation/scene.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {

/// A rock at its release.
struct ReleasedRock {
  std::uint32_t group = 0, variant = 0;
  double sieveM = 0, massKg = 0;
  double reachM = 0;  ///< distance from the centre of mass to the farthest point
  double timeS = 0;
  btTransform pose;
  btVector3 velocity;
};

/// Draws a place of release, evenly. It may be over a hole of the ground.
MapPoint drawPlace(const Release& release, scenes::Random& random);

/// The middle of a piece, which is over the ground where rocks are released from each piece: `prepareScene` looks.
MapPoint middleOf(const PlaceSet& places, std::size_t piece);

/// Returns all rocks of a run, by group and number: a pure function of (scene, run). The height of a centre counts from
/// the place where a ball of the rock's reach would touch the plane of the ground below it. The centre lies
/// `above_ground_m` higher. Rocks released within two seconds of each other that may meet do not overlap.
/// A rock without a free place after 20 draws starts higher. Cost: quadratic in the number of rocks that may meet.
/// Rocks of each place do not go out of each other's way: they begin in their own.
std::vector<ReleasedRock> releaseRocks(const Scene& scene, std::uint64_t run);

}  // namespace cairn::rockfall
