// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce.h"

#include <utility>

#include "balls/ball_fit.h"
#include "balls/farthest_sample.h"
#include "cover/optimise.h"
#include "cover/optimise_one_by_one.h"
#include "medial/medial_spheres.h"
#include "spheres/burst.h"
#include "spheres/expand.h"
#include "spheres/grid.h"
#include "spheres/merge.h"
#include "spheres/spawn.h"

namespace cairn::builder {

namespace {

/// Initial sites of a region's Voronoi diagram.
constexpr std::size_t kInitialSites = 60;
/// Largest number of points added to it. Spheres that move freely afterwards gain nothing from a finer diagram. Spheres
/// that stay do gain. They start from as many points as the thesis uses (7.1.5), here in every region, because regions
/// do not share a diagram.
constexpr std::size_t kMaxInsertions = 100, kMaxInsertionsUnmoved = 1000;
constexpr std::size_t kSpheresUnmoved = 500;

MedialSpheres medialSpheresOf(const CoverProblem& problem, const Region& region, double spacing,
                              const SignedDistance& solid, const SplitSettings& settings) {
  std::vector<Vec3d> list(problem.points.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = problem.points[i];
  const std::vector<Vec3d> sites = farthestPointSample(list, kInitialSites, settings.seed % list.size());
  MedialGoal goal;
  goal.maxStandOff = 0.5 * region.ball.standOff();
  goal.maxOutside = 0.5 * region.ball.standOff();
  const bool moved = settings.optimiser == Optimiser::cairn;
  if (!moved) goal.minSpheres = kSpheresUnmoved;
  goal.maxInsertions = moved ? kMaxInsertions : kMaxInsertionsUnmoved;
  return approximateMedialAxis(solid, problem.points, spacing, sites, goal);
}

/// The candidates from which the reductions of a medial axis start.
struct Candidates {
  std::vector<Ball> covering;  ///< together they hold the region
  std::vector<Ball> all;       ///< includes further balls that may hold much of it once they grow
};

Candidates candidatesFrom(const MedialSpheres& medial, const CoverProblem& problem) {
  Candidates c{medial.inside, medial.inside};
  c.covering.insert(c.covering.end(), medial.coverage.begin(), medial.coverage.end());
  c.all.insert(c.all.end(), medial.outside.begin(), medial.outside.end());
  if (c.covering.empty()) c.covering.push_back(fitBall(problem.points[0], problem.points, problem.solid));
  if (c.all.empty()) c.all = c.covering;
  return c;
}

SphereSet optimised(const CoverProblem& problem, SphereSet set, Optimiser optimiser, int swapRounds) {
  switch (optimiser) {
    case Optimiser::thesis:
      return optimiseOneByOne(problem, std::move(set));
    case Optimiser::cairn:
      return optimiseBySwaps(problem, std::move(set), swapRounds);
    default:
      return set;
  }
}

/// Expand with all candidates and points, as in the thesis, where the set stays as Expand leaves it. Where our
/// optimiser goes on from it, a start from few of them serves as well.
SphereSet expanded(const CoverProblem& problem, const Candidates& candidates, Optimiser optimiser) {
  return expand(problem, candidates.all, ExpandRank::maxElim,
                optimiser == Optimiser::cairn ? ExpandLimits{} : kNoExpandLimits);
}

SphereSet betterOfBoth(const CoverProblem& problem, const Candidates& candidates, Optimiser optimiser) {
  SphereSet expandedSet = expanded(problem, candidates, optimiser), merged = merge(problem, candidates.covering);
  if (optimiser == Optimiser::cairn) {
    expandedSet = optimise(problem, std::move(expandedSet));
    merged = optimise(problem, std::move(merged));
  }
  return coverStandOff(problem.points, merged) < coverStandOff(problem.points, expandedSet) ? merged : expandedSet;
}

SphereSet reducedFrom(const Candidates& candidates, const CoverProblem& problem, const SplitSettings& settings) {
  switch (settings.method) {
    case Method::expand:
      return expanded(problem, candidates, settings.optimiser);
    case Method::merge:
      return merge(problem, candidates.covering);
    case Method::expandCover:
      return expand(problem, candidates.all, ExpandRank::maxCover);
    case Method::burst:
      return burst(problem, candidates.covering);
    default:
      return betterOfBoth(problem, candidates, settings.optimiser);
  }
}

/// These have the same regions and differ in the ball of each.
bool isGrid(Method method) {
  return method == Method::grid || method == Method::gridVolume || method == Method::hybrid;
}

SphereSet reducedSet(const CoverProblem& problem, const Region& region, double spacing, const SignedDistance& solid,
                     const SplitSettings& settings) {
  if (settings.method == Method::spawn) return spawn(problem);
  if (isGrid(settings.method)) return gridSpheres(problem);
  return reducedFrom(candidatesFrom(medialSpheresOf(problem, region, spacing, solid, settings), problem), problem,
                     settings);
}

}  // namespace

SphereSet reduce(const CoverProblem& problem, const Region& region, double spacing, const SignedDistance& solid,
                 const SplitSettings& settings, int swapRounds) {
  return optimised(problem, reducedSet(problem, region, spacing, solid, settings), settings.optimiser, swapRounds);
}

}  // namespace cairn::builder
