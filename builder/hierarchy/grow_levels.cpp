// SPDX-License-Identifier: GPL-3.0-or-later
#include "grow_levels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hierarchy/divide_among_leaves.h"
#include "levels/complete_level.h"
#include "levels/fit_families.h"
#include "levels/two_levels.h"

namespace cairn::builder {

namespace {

/// Points that a level is fitted to: for each ball of a full level, and the least total.
constexpr std::size_t kPointsPerBall = 100, kMinPoints = 1500;
/// Number of points of one family's first fit, and of swaps that try to improve it.
constexpr std::size_t kFamilyPoints = 400;
constexpr int kFamilySwapRounds = 1;
/// Number of attempts to relieve a level.
constexpr ReliefEffort kRelief{.attempts = 80, .redraws = 8};

/// Surface points dense enough for a level of `balls` balls.
PointSet pointsFor(const TriangleMesh& mesh, double balls) {
  Pieces pieces = piecesOf(mesh);
  const auto points = static_cast<std::size_t>(kPointsPerBall * balls);
  refinePieces(pieces, 2 * std::max(points, kMinPoints));  // a closed surface has twice as many triangles as corners
  return PointSet(cornersOf(pieces));
}

/// Fits the level below `levels`: each family alone, then all at once, then where the level is worst and between the
/// points. Its limit holds for the dense points.
CoverLevel nextLevel(std::span<const CoverLevel> levels, PointSet points, const PointSet& dense,
                     const SignedDistance& solid, const SplitSettings& settings) {
  const SolidDepth field(solid);
  const Reach owned = ownedBy(levels.back(), points, reachThrough(levels.first(levels.size() - 1), points));
  const Reach reach = reachThrough(levels, points);
  CoverLevel level;
  LevelProblem problem{points, field, reach, settings.branching, settings.negligible};
  problem.keepGoing = &settings.keepGoing;
  const FamilySettings alone{settings.branching, kFamilyPoints,       kFamilySwapRounds,
                             settings.seed,      settings.negligible, &settings.keepGoing};
  level.balls = optimiseLevel(problem, fitFamilies(owned, points, field, alone));
  const LevelSurface surface{
      points, dense, levels, field, settings.branching, settings.negligible, &settings.keepGoing};
  return completeLevel(surface, std::move(level), kRelief);
}

/// Returns an empty result when `progress` cancelled.
std::vector<CoverLevel> fitLevels(std::uint32_t depth, const SignedDistance& solid, const SplitSettings& settings,
                                  const LevelProgress& progress) {
  const auto ballsOf = [&](std::uint32_t level) { return std::pow(static_cast<double>(settings.branching), level); };
  PointSet points = pointsFor(solid.mesh(), ballsOf(std::min(depth, 2U)));
  PointSet dense = pointsFor(solid.mesh(), ballsOf(std::min(depth, 2U) + 1));
  const TwoLevelProblem upper{
      points, dense, solid, settings.branching, settings.seed, settings.negligible, depth > 2, &settings.keepGoing};
  std::vector<CoverLevel> levels = depth == 1 ? std::vector{coverOneLevel(upper)} : coverTwoLevels(upper);
  if (!settings.keepGoing()) return {};
  while (levels.size() < depth) {
    const auto done = static_cast<std::uint32_t>(levels.size());
    if (!progress(done - 1, 1, 1)) return {};
    points = std::move(dense);
    dense = pointsFor(solid.mesh(), ballsOf(done + 2));
    widenLimits(levels, dense);
    levels.push_back(nextLevel(levels, points, dense, solid, settings));
  }
  return levels;
}

}  // namespace

RegionTree growLevels(Region root, std::uint32_t depth, const SignedDistance& solid, const SplitSettings& settings,
                      const LevelProgress& progress) {
  if (root.ball.standOff() <= settings.negligible) return {{std::move(root), 0, 0, 0}};
  const std::vector<CoverLevel> levels = fitLevels(depth, solid, settings, progress);
  if (levels.empty() || !progress(depth - 1, 1, 1)) return {};
  return divideAmongLeaves(std::move(root), levels, solid);
}

}  // namespace cairn::builder
