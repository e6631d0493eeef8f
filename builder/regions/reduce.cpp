// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce.h"

#include <utility>
#include <variant>

#include "balls/farthest_sample.h"
#include "cover/optimise.h"
#include "cover/optimise_one_by_one.h"
#include "medial/candidates.h"
#include "medial/medial_spheres.h"
#include "regions/method_traits.h"

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

SphereSet reducedSet(const CoverProblem& problem, const Region& region, double spacing, const SignedDistance& solid,
                     const SplitSettings& settings) {
  const SphereFit& fit = traitsOf(settings.method).fit;
  if (const auto* const fromPoints = std::get_if<FitToPoints>(&fit)) return (*fromPoints)(problem);
  const MedialSpheres medial = medialSpheresOf(problem, region, spacing, solid, settings);
  return std::get<FitFromMedial>(fit)(settings.optimiser, problem, candidatesFrom(medial, problem));
}

}  // namespace

SphereSet reduce(const CoverProblem& problem, const Region& region, double spacing, const SignedDistance& solid,
                 const SplitSettings& settings, int swapRounds) {
  return optimised(problem, reducedSet(problem, region, spacing, solid, settings), settings.optimiser, swapRounds);
}

}  // namespace cairn::builder
