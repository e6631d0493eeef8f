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

SphereSet betterOfBoth(const CoverProblem& problem, const Candidates& candidates, Optimiser optimiser) {
  SphereSet expanded = expand(problem, candidates.all), merged = merge(problem, candidates.covering);
  if (optimiser == Optimiser::cairn) {
    expanded = optimise(problem, std::move(expanded));
    merged = optimise(problem, std::move(merged));
  }
  return coverStandOff(problem.points, merged) < coverStandOff(problem.points, expanded) ? merged : expanded;
}

SphereSet reducedFrom(const Candidates& candidates, const CoverProblem& problem, const SplitSettings& settings) {
  switch (settings.method) {
    case Method::expand:
      return expand(problem, candidates.all);
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

SphereSet reducedSet(const CoverProblem& problem, const Region& region, double spacing, const SignedDistance& solid,
                     const SplitSettings& settings) {
  if (settings.method == Method::spawn) return spawn(problem);
  if (settings.method == Method::grid || settings.method == Method::hybrid) return gridSpheres(problem);
  return reducedFrom(candidatesFrom(medialSpheresOf(problem, region, spacing, solid, settings), problem), problem,
                     settings);
}

}  // namespace

SphereSet reduce(const CoverProblem& problem, const Region& region, double spacing, const SignedDistance& solid,
                 const SplitSettings& settings, int swapRounds) {
  return optimised(problem, reducedSet(problem, region, spacing, solid, settings), settings.optimiser, swapRounds);
}

}  // namespace cairn::builder
