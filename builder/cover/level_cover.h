// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "balls/sphere_set.h"
#include "cairn/builder/progress.h"

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
  double worthARound = 0.01;  ///< rounds end when not even this part of the worst stand-off can be saved
  /// Asked between sweeps, if there; once it says no, what is found is not to be used.
  const KeepGoing* keepGoing = nullptr;

  bool goesOn() const { return keepGoing == nullptr || (*keepGoing)(); }
};

/// Worst over the points of the least cost over the balls that may hold them.
double coverStandOff(const LevelProblem& problem, std::span<const ChildBall> balls);

/// Lowers the worst stand-off of a level by moving its balls (the purpose of thesis Alg. 9; the method is ours).
/// Returns a level at least as good as `start`, radii as needed for the points each ball holds most cheaply, balls
/// without points dropped, ordered by parent. Deterministic.
///
/// A round asks for a stand-off somewhat below the present worst. Ball by ball, worst first, a centre is moved downhill
/// for the points that are the ball's own duty: those no other ball holds at that stand-off. Points that another ball
/// holds as well are free, which lets the error spread over the whole set as in Expand, without a fixed list of
/// candidates. A ball without any duty goes where its parent's reach is covered worst; families that are not full are
/// filled up in the same way.
///
/// A sweep is linear in the sum of the balls' reaches, but for the points whose two cheapest balls move.
std::vector<ChildBall> optimiseLevel(const LevelProblem& problem, std::vector<ChildBall> start);

}  // namespace cairn::builder
