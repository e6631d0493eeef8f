// SPDX-License-Identifier: GPL-3.0-or-later
#include "complete_level.h"

#include <algorithm>
#include <utility>

namespace cairn::builder {

namespace {

constexpr int kRounds = 8;
/// Attempts of each relief after the first. Later reliefs only repair, and most points need one attempt.
constexpr std::size_t kRepairs = 20;
/// Dense points within this factor of the points' need are not added.
constexpr double kComplete = 1.01;

}  // namespace

CoverLevel completeLevel(const LevelSurface& surface, CoverLevel level, const ReliefEffort& effort) {
  const Reach denseReach = reachThrough(surface.above, surface.dense);
  CoverLevel best;
  const ReliefEffort repair{std::min(effort.attempts, kRepairs), effort.redraws};
  double reliefGoal = surface.negligible;  // stand-off after the first relief; later reliefs only repair the level
  for (int round = 0; round < kRounds; ++round) {
    const Reach reach = reachThrough(surface.above, surface.points);
    LevelProblem problem{surface.points, surface.field, reach, surface.branching, reliefGoal};
    problem.keepGoing = surface.keepGoing;
    if (!problem.goesOn()) return level;
    level.balls = relieveLevel(problem, level.balls, round == 0 ? effort : repair);
    level.limit = std::max(coverStandOff(problem, level.balls), surface.negligible);
    reliefGoal = std::max(reliefGoal, round == 0 ? level.limit : 0);
    CoverLevel whole = level;
    whole.limit = std::max(standOffOf(level, surface.dense, denseReach), surface.negligible);
    const bool complete = whole.limit <= kComplete * level.limit;
    if (round == 0 || whole.limit < best.limit) best = std::move(whole);
    if (complete) break;
    for (const Vec3d& p : nearlyWorst(level, surface.dense, denseReach)) surface.points.push(p);
  }
  return best;
}

}  // namespace cairn::builder
