// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spheres/sphere_set.h"

namespace cairn::builder {

/// A ball of a level and the ball of the level above that it hangs below.
struct ChildBall {
  Ball ball;
  std::uint32_t parent = 0;
};

/// Cover `points` by the balls of one level of a tree, all families at once. A child may only hold points its parent
/// holds, and where parents overlap either one's children may: so a family that is hard to cover hands surface to its
/// neighbours, which fitting each family for itself cannot.
struct LevelProblem {
  const PointSet& points;  ///< on the surface, mesh frame; not empty
  const DepthField& solid;
  /// By parent: the points its children may hold, ascending. Every point is in at least one list.
  std::span<const std::vector<std::uint32_t>> reach;
  std::size_t branching = 8;  ///< most children of a parent, at least 1
  double enough = 0;          ///< stand-off below which nothing is improved any further
};

/// Worst over the points of the least cost over the balls that may hold them.
double coverStandOff(const LevelProblem& problem, std::span<const ChildBall> balls);

/// Lowers the worst stand-off of a level by moving its balls, as `optimise` does for a single family: rounds ask for
/// somewhat less than the present worst, and ball by ball a centre moves downhill for the points no other ball holds at
/// that stand-off. A ball without any goes where its parent's reach is covered worst; families that are not full are
/// filled up in the same way. Returns a level at least as good as `start`, radii as needed for the points each ball
/// holds most cheaply, balls without points dropped, ordered by parent. Deterministic.
///
/// A sweep is linear in the sum of the balls' reaches, but for the points whose two cheapest balls move.
std::vector<ChildBall> optimiseLevel(const LevelProblem& problem, std::vector<ChildBall> start);

}  // namespace cairn::builder
