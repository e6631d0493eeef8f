// SPDX-License-Identifier: GPL-3.0-or-later
// Whole levels at once: assignment to families against brute force, and what optimising a level promises.
#include "cover/level_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "cairn/builder/certify.h"
#include "cover/capacity_assignment.h"
#include "levels/cover_level.h"
#include "levels/relieve_level.h"

namespace cairn::builder::level_cover_test {
namespace {

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) / 9007199254740992.0;
}

double worstOf(const CostTable& table, const std::vector<std::uint32_t>& bins) {
  double worst = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) worst = std::max(worst, table.at(i, bins[i]));
  return worst;
}

// Tries every way to give the items from `item` on to bins.
void tryAll(const CostTable& table, std::size_t capacity, std::vector<std::uint32_t>& bins, std::size_t item,
            double& best) {
  if (item == table.items()) {
    best = std::min(best, worstOf(table, bins));
    return;
  }
  for (std::uint32_t k = 0; k < table.bins; ++k) {
    const auto before = bins.begin() + static_cast<std::ptrdiff_t>(item);
    if (std::count(bins.begin(), before, k) >= static_cast<std::ptrdiff_t>(capacity)) continue;
    bins[item] = k;
    tryAll(table, capacity, bins, item + 1, best);
  }
}

TEST(CapacityAssignment, IsAsGoodAsTryingEveryWay) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const std::size_t bins = 1 + random() % 3, capacity = 1 + random() % 3;
    const std::size_t items = 1 + random() % (bins * capacity);
    CostTable table{bins, {}};
    for (std::size_t i = 0; i < items * bins; ++i) table.costs.push_back(uniform(random));
    const std::vector<std::uint32_t> assigned = assignWithin(table, capacity);
    ASSERT_EQ(assigned.size(), items);
    for (std::uint32_t k = 0; k < bins; ++k)
      EXPECT_LE(std::count(assigned.begin(), assigned.end(), k), static_cast<std::ptrdiff_t>(capacity));
    std::vector<std::uint32_t> tried(items);
    double best = std::numeric_limits<double>::infinity();
    tryAll(table, capacity, tried, 0, best);
    EXPECT_EQ(worstOf(table, assigned), best);
  }
}

class LevelOfABall : public testing::TestWithParam<std::uint64_t> {
 protected:
  LevelOfABall() : mesh(test::lumpyBall(2, GetParam())), solid(mesh), depth(solid) {
    Pieces pieces = piecesOf(mesh);
    refinePieces(pieces, 600);
    points = PointSet(cornersOf(pieces));
    std::mt19937_64 random(GetParam());
    // Parents: random halves of the surface that overlap, and everything once, so that no point is without.
    reach = reachOfAll(points.size());
    for (int k = 0; k < 3; ++k) {
      const Vec3d axis = normalized(Vec3d(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5));
      reach.emplace_back();
      for (std::uint32_t p = 0; p < points.size(); ++p)
        if (dot(axis, points[p]) > -0.1) reach.back().push_back(p);
    }
  }

  TriangleMesh mesh;
  SignedDistance solid;
  SolidDepth depth;
  PointSet points;
  Reach reach;
};

INSTANTIATE_TEST_SUITE_P(Seeds, LevelOfABall, testing::Range<std::uint64_t>(1, 6));

TEST_P(LevelOfABall, HoldsEveryPointAtItsStandOff_WithinItsFamilies) {
  const LevelProblem problem{points, depth, reach, 3};
  const std::vector<ChildBall> level = optimiseLevel(problem, {});
  const double standOff = coverStandOff(problem, level);
  ASSERT_LT(standOff, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> members(reach.size(), 0);
  for (const ChildBall& child : level) {
    ++members[child.parent];
    EXPECT_LE(child.ball.standOff(), standOff);
  }
  for (const std::size_t count : members) EXPECT_LE(count, 3U);
  // By brute force, and with the radii given: each point lies in a ball whose parent reaches it.
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const bool held = std::ranges::any_of(level, [&](const ChildBall& child) {
      return std::ranges::binary_search(reach[child.parent], p) &&
             distance(child.ball.center, points[p]) <= child.ball.radius * (1 + 1e-12);
    });
    EXPECT_TRUE(held) << "point " << p;
  }
}

TEST_P(LevelOfABall, OptimisingNeverMakesItWorse) {
  const LevelProblem problem{points, depth, reach, 3};
  std::mt19937_64 random(GetParam());
  std::vector<ChildBall> start;
  for (std::uint32_t parent = 0; parent < reach.size(); ++parent) {
    const Vec3d center(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
    start.push_back({{center, 0, depth.depth(center)}, parent});
  }
  EXPECT_LE(coverStandOff(problem, optimiseLevel(problem, start)), coverStandOff(problem, start));
}

TEST_P(LevelOfABall, RelievingNeverMakesItWorse_AndKeepsFamiliesSmall) {
  const LevelProblem problem{points, depth, reach, 3};
  std::vector<ChildBall> start;
  for (std::uint32_t parent = 0; parent < reach.size(); ++parent) {
    const Vec3d center = points[reach[parent].front()];
    start.push_back({{center, 0, depth.depth(center)}, parent});
  }
  double last = coverStandOff(problem, start);
  for (const std::size_t attempts : {1U, 5U, 50U}) {
    const std::vector<ChildBall> level = relieveLevel(problem, start, {attempts, 4});
    std::vector<std::size_t> members(reach.size(), 0);
    for (const ChildBall& child : level) ++members[child.parent];
    for (const std::size_t count : members) EXPECT_LE(count, 3U);
    // Worst by brute force: over the points, the cheapest ball whose parent reaches the point. More attempts begin with
    // the same ones.
    double worst = 0;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      double least = std::numeric_limits<double>::infinity();
      for (const ChildBall& child : level)
        if (std::ranges::binary_search(reach[child.parent], p)) least = std::min(least, costOf(child.ball, points[p]));
      worst = std::max(worst, least);
    }
    EXPECT_LE(worst, last);
    last = worst;
  }
}

/// Eight balls for the whole of a lumpy ball, where optimising leaves them.
struct OptimisedLumpyBall {
  explicit OptimisedLumpyBall(std::uint64_t seed) : mesh(test::lumpyBall(2, seed)), solid(mesh), depth(solid) {
    Pieces pieces = piecesOf(mesh);
    refinePieces(pieces, 1500);
    points = PointSet(cornersOf(pieces));
    all = reachOfAll(points.size());
    level = optimiseLevel(problem(), {});
  }
  LevelProblem problem() const { return {points, depth, all, 8}; }
  double relieved(const ReliefEffort& effort) const {
    return coverStandOff(problem(), relieveLevel(problem(), level, effort));
  }

  TriangleMesh mesh;
  SignedDistance solid;
  SolidDepth depth;
  PointSet points;
  Reach all;
  std::vector<ChildBall> level;
};

/// Where optimising ends, second chances still find something on most bodies.
TEST(RelieveLevel, LowersWhatOptimisingLeaves) {
  int lowered = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const OptimisedLumpyBall ball(seed);
    if (ball.relieved({20, 0}) < coverStandOff(ball.problem(), ball.level)) ++lowered;
  }
  EXPECT_GE(lowered, 3);
}

/// Where moving balls and setting them down anew ends, a family begun anew goes on.
TEST(RelieveLevel, LowersMoreWhereFamiliesAreDrawnAnew) {
  int lowered = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const OptimisedLumpyBall ball(seed);
    const double moved = ball.relieved({60, 0}), drawn = ball.relieved({60, 8});
    EXPECT_LE(drawn, moved) << "seed " << seed;
    if (drawn < moved) ++lowered;
  }
  EXPECT_GE(lowered, 2);
}

TEST(Adaptive, RefusesMoreSpheresThanItCanFitAtOnce) {
  BuildOptions options;
  options.method = Method::adaptive;
  options.depth = 6;
  const auto tree = buildTree(test::lumpyBall(1, 1), options);
  ASSERT_FALSE(tree);
  EXPECT_NE(tree.error().message.find("8^6"), std::string::npos) << tree.error().message;
}

TEST(Adaptive, FitsBetterThanRegionByRegion) {
  const TriangleMesh mesh = test::lumpyBall(3, 5);
  BuildOptions options;
  options.depth = 2;
  options.method = Method::combined;
  const auto combined = buildTree(mesh, options);
  options.method = Method::adaptive;
  const auto adaptive = buildTree(mesh, options);
  ASSERT_TRUE(combined && adaptive);
  EXPECT_LT(adaptive.value().levelError(2), combined.value().levelError(2));
}

/// Measured: 1.10, over ten seeds 1.15. With one draw of the families for each size of their flat cover it was 1.42,
/// so 1.2 tells a search that chooses among draws from one that depends on them.
TEST(Adaptive, NoSeedLosesTheSecondLevel) {
  constexpr double kMaxApart = 1.2;
  const TriangleMesh mesh = test::lumpyBall(2, 1);
  double best = std::numeric_limits<double>::infinity(), worst = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    BuildOptions options;
    options.method = Method::adaptive;
    options.branching = 4;
    options.depth = 3;
    options.seed = seed;
    const auto tree = buildTree(mesh, options);
    ASSERT_TRUE(tree) << "seed " << seed;
    best = std::min(best, static_cast<double>(tree.value().levelError(2)));
    worst = std::max(worst, static_cast<double>(tree.value().levelError(2)));
  }
  EXPECT_LE(worst, kMaxApart * best);
}

}  // namespace
}  // namespace cairn::builder::level_cover_test
