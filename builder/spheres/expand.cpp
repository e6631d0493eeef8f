// SPDX-License-Identifier: GPL-3.0-or-later
#include "expand.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "balls/farthest_sample.h"
#include "spheres/expand_selection.h"

namespace cairn::builder {

namespace {

/// Growth factor of the stand-off in the search for a set of more than one ball, and the largest number of steps.
constexpr double kNextStandOff = 1.05;
constexpr int kMaxSteps = 20;

std::vector<Ball> thinned(std::span<const Ball> candidates, std::size_t most) {
  const std::size_t count = std::min(candidates.size(), most);
  std::vector<Ball> kept;
  for (std::size_t k = 0; k < count; ++k) kept.push_back(candidates[k * candidates.size() / count]);
  return kept;
}

PointSet thinned(const PointSet& points, std::size_t most) {
  std::vector<Vec3d> list(points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = points[i];
  return PointSet(farthestPointSample(list, most, 0));
}

/// For some shapes, such as the cube, one ball suffices at a lower stand-off than the wanted number of smaller ones.
/// The search above then always ends with that ball. Without the balls that hold everything, the smaller ones are
/// considered (5.3.3).
Expanded divided(const ExpandCosts& costs, std::size_t count, Expanded single) {
  double standOff = single.standOff;
  for (int step = 0; step < kMaxSteps; ++step, standOff *= kNextStandOff) {
    const ExpandSelection selection = costs.at(standOff);
    if (auto chosen = selection.choose(count, selection.complete()).chosen) return {*std::move(chosen), standOff};
  }
  return single;
}

}  // namespace

SphereSet expand(const CoverProblem& problem, std::span<const Ball> candidates, ExpandRank rank,
                 const ExpandLimits& limits) {
  assert(!candidates.empty() && !problem.points.empty());
  const bool all = rank == ExpandRank::maxCover;
  const std::vector<Ball> kept = thinned(candidates, all ? candidates.size() : limits.candidates);
  const PointSet points = all ? problem.points : thinned(problem.points, limits.points);
  const ExpandCosts costs(points, kept, rank);
  Expanded best = costs.leastFor(problem.count, limits.bisections);
  if (best.chosen.size() == 1 && problem.count > 1) best = divided(costs, problem.count, std::move(best));
  SphereSet set;
  for (const std::size_t i : best.chosen) set.push_back({kept[i].center, best.standOff + kept[i].depth, kept[i].depth});
  return set;
}

}  // namespace cairn::builder
