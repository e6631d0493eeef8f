// SPDX-License-Identifier: GPL-3.0-or-later
#include "grow_levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hierarchy/divide_among_leaves.h"
#include "hierarchy/two_levels.h"
#include "spheres/ball_fit.h"
#include "spheres/optimise.h"

namespace cairn::builder {

namespace {

/// Points a level is fitted to, for each ball a full level has; and in all at least.
constexpr std::size_t kPointsPerBall = 100, kMinPoints = 1500;
/// Points of one family's first fit, and swaps tried to improve it.
constexpr std::size_t kFamilyPoints = 400;
constexpr int kFamilySwapRounds = 1;
/// How often a level is fitted, each time to more of the points that cost most.
constexpr int kSeamRounds = 3;

/// Corners of the region's pieces, cut finely enough for a level of `balls` balls.
PointSet pointsFor(const Region& root, double balls) {
  Pieces pieces = root.pieces;
  const auto points = static_cast<std::size_t>(kPointsPerBall * balls);
  refinePieces(pieces, 2 * std::max(points, kMinPoints));  // a closed surface has twice as many triangles as corners
  return PointSet(cornersOf(pieces));
}

/// The best cover of one family's own points, for itself.
SphereSet fitFamily(const std::vector<std::uint32_t>& owned, const PointSet& points, const DepthField& field,
                    const SplitSettings& settings) {
  std::vector<Vec3d> list;
  for (const std::uint32_t p : owned) list.push_back(points[p]);
  const PointSet few(farthestPointSample(list, kFamilyPoints, settings.seed % list.size()));
  const CoverProblem problem{few, field, settings.branching};
  const SphereSet one{fitBall(few[0], few, field)};
  if (one[0].standOff() <= settings.negligible) return one;
  return optimiseBySwaps(problem, one, kFamilySwapRounds);
}

std::vector<ChildBall> fitFamilies(const Reach& owned, const PointSet& points, const DepthField& field,
                                   const SplitSettings& settings) {
  std::vector<SphereSet> families(owned.size());
  tbb::parallel_for(std::size_t{0}, owned.size(), [&](std::size_t i) {
    if (!owned[i].empty()) families[i] = fitFamily(owned[i], points, field, settings);
  });
  std::vector<ChildBall> level;
  for (std::uint32_t parent = 0; parent < families.size(); ++parent)
    for (const Ball& ball : families[parent]) level.push_back({ball, parent});
  return level;
}

/// The level below `levels`: each family for itself first, then all at once, then also for what lies between the
/// points. Its limit holds for the dense points.
CoverLevel nextLevel(std::span<const CoverLevel> levels, PointSet points, const PointSet& dense,
                     const SignedDistance& solid, const SplitSettings& settings) {
  const SolidDepth field(solid);
  const Reach owned = ownedBy(levels.back(), points, reachThrough(levels.first(levels.size() - 1), points));
  const Reach denseReach = reachThrough(levels, dense);
  CoverLevel level{fitFamilies(owned, points, field, settings), 0};
  for (int round = 0; round < kSeamRounds; ++round) {
    const Reach reach = reachThrough(levels, points);
    const LevelProblem problem{points, field, reach, settings.branching, settings.negligible};
    level.balls = optimiseLevel(problem, std::move(level.balls));
    level.limit = coverStandOff(problem, level.balls);
    if (round + 1 == kSeamRounds || level.limit <= settings.negligible) break;
    for (const Vec3d& p : nearlyWorst(level, dense, denseReach)) points.push(p);
  }
  level.limit = std::max(standOffOf(level, dense, denseReach), settings.negligible);
  return level;
}

}  // namespace

RegionTree growLevels(Region root, std::uint32_t depth, const SignedDistance& solid, const SplitSettings& settings,
                      const LevelProgress& progress) {
  if (root.ball.standOff() <= settings.negligible) return {{std::move(root), 0, 0, 0}};
  const auto ballsOf = [&](std::uint32_t level) { return std::pow(static_cast<double>(settings.branching), level); };
  PointSet points = pointsFor(root, ballsOf(std::min(depth, 2U)));
  PointSet dense = pointsFor(root, ballsOf(std::min(depth, 2U) + 1));
  const TwoLevelProblem upper{points, dense, solid, settings.branching, settings.seed, settings.negligible};
  std::vector<CoverLevel> levels = depth == 1 ? std::vector{coverOneLevel(upper)} : coverTwoLevels(upper);
  while (levels.size() < depth) {
    const auto done = static_cast<std::uint32_t>(levels.size());
    if (!progress(done - 1, 1, 1)) return {};
    points = std::move(dense);
    dense = pointsFor(root, ballsOf(done + 2));
    widenLimits(levels, dense);
    levels.push_back(nextLevel(levels, points, dense, solid, settings));
  }
  if (!progress(depth - 1, 1, 1)) return {};
  return divideAmongLeaves(std::move(root), levels, solid);
}

}  // namespace cairn::builder
