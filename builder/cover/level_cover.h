// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "balls/sphere_set.h"
#include "cairn/builder/progress.h"

namespace cairn::builder {

/// A ball of a level, and the index of its parent in the level above.
struct ChildBall {
  Ball ball;
  std::uint32_t parent = 0;
};

/// The task: cover `points` by the balls of one level of a tree, all families at once. A child may hold only points
/// that its parent holds. Where parents overlap, the children of either may hold the points. So a family that is hard
/// to cover can give surface to its neighbours, which is impossible when each family is fitted alone.
struct LevelProblem {
  const PointSet& points;  ///< on the surface, mesh frame; not empty
  const DepthField& solid;
  /// By parent: the points its children may hold, ascending. Every point is in at least one list.
  std::span<const std::vector<std::uint32_t>> reach;
  std::size_t branching = 8;  ///< most children of a parent, at least 1
  double enough = 0;          ///< stand-off below which nothing is improved any further
  double worthARound = 0.01;  ///< rounds end when they cannot save this fraction of the worst stand-off
  /// Called between sweeps when not null. Once it returns false, the result must not be used.
  const KeepGoing* keepGoing = nullptr;

  bool goesOn() const { return keepGoing == nullptr || (*keepGoing)(); }
};

/// Returns the largest, over the points, of the least cost over the balls that may hold the point.
double coverStandOff(const LevelProblem& problem, std::span<const ChildBall> balls);

/// Lowers the worst stand-off of a level by moves of its balls (the purpose of thesis Alg. 9; the method is Cairn's
/// own). Returns a level at least as good as `start`, ordered by parent. Radii are those needed for the points that
/// each ball holds most cheaply; balls without points are dropped. Deterministic.
///
/// A round aims at a stand-off somewhat below the present worst. Ball by ball, worst first, a centre moves downhill for
/// the points of the ball's own duty. These are the points that no other ball holds at that stand-off. Points that
/// another ball also holds are free. So the error spreads over the whole set as in Expand, without a fixed list of
/// candidates. A ball without any duty goes where its parent's reach is covered worst. Families that are not full are
/// filled up in the same way.
///
/// A sweep is linear in the sum of the balls' reaches, except for the points whose two cheapest balls move.
std::vector<ChildBall> optimiseLevel(const LevelProblem& problem, std::vector<ChildBall> start);

}  // namespace cairn::builder
