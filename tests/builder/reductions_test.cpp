// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "balls/ball_fit.h"
#include "balls/piece.h"
#include "builder_meshes.h"
#include "cover/downhill_simplex.h"
#include "cover/optimise_one_by_one.h"
#include "spheres/burst.h"
#include "spheres/expand.h"
#include "spheres/grid.h"
#include "spheres/oriented_grid.h"
#include "spheres/spawn.h"

namespace cairn::builder::reductions_test {
namespace {

// Distances of solids of size 1 to 3, each rounded by 2^-53 of its size.
constexpr double kRounding = 1e-12;

/// A solid, points of its surface and candidate balls at random places inside.
struct Fixture {
  Fixture(TriangleMesh m, std::uint64_t seed, std::size_t pieceCount = 500)
      : mesh(std::move(m)), solid(mesh), depth(solid) {
    Pieces pieces = piecesOf(mesh);
    refinePieces(pieces, pieceCount);
    points = PointSet(cornersOf(pieces));
    const Bounds bounds = boundsOf(mesh);
    std::mt19937_64 engine(seed);
    while (candidates.size() < 120) {
      const Vec3d center(test::uniform(engine, bounds.lower.x, bounds.upper.x),
                         test::uniform(engine, bounds.lower.y, bounds.upper.y),
                         test::uniform(engine, bounds.lower.z, bounds.upper.z));
      const double s = solid.depth(center);
      if (s > 0) candidates.push_back({center, s, s});
    }
  }

  TriangleMesh mesh;
  SignedDistance solid;
  SolidDepth depth;
  PointSet points;
  std::vector<Ball> candidates;
};

/// Symmetric, round, concave and random solids.
std::vector<TriangleMesh> solids(std::uint64_t seed) {
  return {test::meshOf(test::cuboid({1, 1, 1}, 2)), test::meshOf(test::cuboid({2, 0.5, 0.5}, 1)),
          test::meshOf(test::ball(1, 2)), test::torus(1, 0.3, 24, 12), test::lumpyBall(2, seed)};
}

struct Reduction {
  const char* name;
  SphereSet (*run)(const CoverProblem&, std::span<const Ball>);
};

const std::vector<Reduction>& reductions() {
  static const std::vector<Reduction> list{
      {"burst", burst},
      {"expandCover",
       [](const CoverProblem& p, std::span<const Ball> c) { return expand(p, c, ExpandRank::maxCover); }},
      {"expandCoverOneByOne",
       [](const CoverProblem& p, std::span<const Ball> c) {
         return optimiseOneByOne(p, expand(p, c, ExpandRank::maxCover));
       }},
      {"grid", [](const CoverProblem& p, std::span<const Ball>) { return gridSpheres(p); }},
      {"spawn", [](const CoverProblem& p, std::span<const Ball>) { return spawn(p); }},
  };
  return list;
}

class EveryReduction : public testing::TestWithParam<Reduction> {};
INSTANTIATE_TEST_SUITE_P(Spheres, EveryReduction, testing::ValuesIn(reductions()),
                         [](const auto& reduction) { return std::string(reduction.param.name); });

TEST_P(EveryReduction, AnySolidAndCount_CoversEveryPointWithNoMoreThanAsked) {
  for (const std::uint64_t seed : {std::uint64_t{3}}) {
    const std::vector<TriangleMesh> meshes = solids(seed);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const Fixture f(meshes[i], seed);
      for (const std::size_t count : {1, 2, 8}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", mesh " + std::to_string(i) + ", " + std::to_string(count));
        const SphereSet set = GetParam().run({f.points, f.depth, count}, f.candidates);
        EXPECT_LE(set.size(), count);
        std::size_t outside = 0;
        for (std::size_t p = 0; p < f.points.size(); ++p)
          outside += std::ranges::none_of(
              set, [&](const Ball& ball) { return distance(ball.center, f.points[p]) <= ball.radius + kRounding; });
        EXPECT_EQ(outside, 0U);
        for (const Ball& ball : set) EXPECT_NEAR(ball.depth, f.solid.depth(ball.center), kRounding);
      }
    }
  }
}

TEST_P(EveryReduction, MoreBalls_NeedNoLargerStandOff) {
  const Fixture f(test::torus(1, 0.3, 24, 12), 5);
  double last = coverStandOff(f.points, GetParam().run({f.points, f.depth, 1}, f.candidates));
  const double one = last;
  for (const std::size_t count : {3, 8}) {
    const double standOff = coverStandOff(f.points, GetParam().run({f.points, f.depth, count}, f.candidates));
    EXPECT_LE(standOff, last);
    last = standOff;
  }
  EXPECT_LT(last, one);
}

TEST(Burst, RedundantBalls_GoFirst) {
  // Eight balls that hold the octants of a cube, and forty that hold one point each which those hold too. No removal of
  // one of the forty makes a ball grow, so the octants are left, at the stand-off they have or a tighter fit's.
  const Fixture f(test::meshOf(test::cuboid({1, 1, 1}, 2)), 1);
  std::vector<Ball> candidates;
  const double radius = std::sqrt(3.0) / 4 * (1 + kRounding);
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3d c((i & 1U) != 0 ? 0.25 : -0.25, (i & 2U) != 0 ? 0.25 : -0.25, (i & 4U) != 0 ? 0.25 : -0.25);
    candidates.push_back({c, radius, f.solid.depth(c)});
  }
  const double best = coverStandOff(f.points, candidates);
  for (std::size_t p = 0; p < 40; ++p) candidates.push_back({f.points[p], 1e-9, f.solid.depth(f.points[p])});
  EXPECT_LE(coverStandOff(f.points, burst({f.points, f.depth, 8}, candidates)), best + kRounding);
}

TEST(Expand, CubeWithACandidateInTheMiddle_IsStillDivided) {
  // One ball holds the cube at (sqrt(3) - 1) / 2; two of these holding no more than a corner each cannot.
  const Fixture f(test::meshOf(test::cuboid({1, 1, 1}, 2)), 1);
  std::vector<Ball> candidates{{{0, 0, 0}, 0.5, 0.5}};
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3d c((i & 1U) != 0 ? 0.1 : -0.1, (i & 2U) != 0 ? 0.1 : -0.1, (i & 4U) != 0 ? 0.1 : -0.1);
    candidates.push_back({c, 0.4, 0.4});
  }
  for (const ExpandRank rank : {ExpandRank::maxElim, ExpandRank::maxCover})
    for (const std::size_t count : {2, 4, 8})
      EXPECT_GE(expand({f.points, f.depth, count}, candidates, rank).size(), 2U);
}

TEST(Expand, MaxCover_TakesTheBallThatHoldsMostFirst) {
  const Fixture f(test::torus(1, 0.3, 24, 12), 8);
  const SphereSet set = expand({f.points, f.depth, 8}, f.candidates, ExpandRank::maxCover);
  const auto contactsIn = [&](const Ball& ball, double standOff) {
    std::size_t held = 0;
    for (std::size_t p = 0; p < f.points.size(); ++p) held += costOf(ball, f.points[p]) <= standOff ? 1 : 0;
    return held;
  };
  // By the listing the first ball holds as many points as any candidate; a retry bars two of the best at most.
  std::vector<std::size_t> counts;
  for (const Ball& c : f.candidates) counts.push_back(contactsIn(c, set[0].standOff()));
  std::sort(counts.rbegin(), counts.rend());
  EXPECT_GE(contactsIn(set[0], set[0].standOff()), counts[2]);
}

TEST(OptimiseOneByOne, AnySet_IsNeverWorsenedAndPoorOnesAreImproved) {
  for (const std::uint64_t seed : {std::uint64_t{11}, std::uint64_t{12}, std::uint64_t{13}}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Fixture f(test::lumpyBall(2, seed), seed);
    const CoverProblem problem{f.points, f.depth, 6};
    // The candidates are at random places: six of them, far from any optimum.
    const SphereSet poor(f.candidates.begin(), f.candidates.begin() + 6);
    const double before = coverStandOff(f.points, poor);
    const SphereSet once = optimiseOneByOne(problem, poor);
    EXPECT_LE(once.size(), 6U);
    EXPECT_LT(coverStandOff(f.points, once), 0.8 * before);
    EXPECT_LE(coverStandOff(f.points, optimiseOneByOne(problem, once)), coverStandOff(f.points, once) + kRounding);
  }
}

TEST(OptimiseOneByOne, OneBall_BecomesNearlyTheBestOne) {
  // For a single ball the simplex and the bundle method lower the same figure.
  const Fixture f(test::lumpyBall(2, 7), 7);
  const SphereSet start{ballAround(f.candidates[0].center, f.points, f.depth)};
  const double simplex = coverStandOff(f.points, optimiseOneByOne({f.points, f.depth, 1}, start));
  // The best of a hundred evaluations with four unknowns, against a method that sees gradients.
  EXPECT_LE(simplex, 1.1 * fitBall(f.candidates[0].center, f.points, f.depth).standOff());
}

TEST(OrientedGrid, PrincipalAxes_AreABoxsOwn) {
  const std::vector<Vec3d> points = test::meshOf(test::cuboid({3, 2, 1}, 4)).vertices;
  const OrientedGrid grid = principalGrid(points);
  // The margin for rounding is 1e-7 of the box on either side.
  EXPECT_NEAR(grid.edge, 3, 1e-6);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(length(grid.axes[i]), 1, kRounding);
    EXPECT_NEAR(dot(grid.axes[i], grid.axes[(i + 1) % 3]), 0, kRounding);
    // The moments of a box along its edges differ, so its axes are the principal ones.
    const Vec3d& a = grid.axes[i];
    EXPECT_NEAR(std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}), 1, 1e-3);
  }
  EXPECT_EQ(coverByGrid(grid, points).centers.size(), 1U);
}

TEST(OrientedGrid, Cover_MatchesTheListingDoneByHand) {
  std::mt19937_64 engine(17);
  for (int trial = 0; trial < 80; ++trial) {
    // Every other one a rod in cells as small as it is thin: far more of them than can be listed.
    const bool isRod = trial % 2 != 0;
    std::vector<Vec3d> points(1 + engine() % 30);
    for (Vec3d& p : points) {
      p = test::randomPoint(engine);
      if (isRod) p.x *= 1e3;
    }
    OrientedGrid grid = principalGrid(points);
    grid.edge *= test::uniform(engine, 0.3, 1) * (isRod ? 1e-3 : 1);
    grid = moved(grid, {0.3, -0.2, 0.1, 0.5, -0.4, 0.3}, points[0]);
    const GridCover cover = coverByGrid(grid, points);
    std::vector<bool> covered(points.size(), false);
    double metric = 0;
    std::size_t last = points.size();
    for (const Vec3d& center : cover.centers) {
      std::size_t fresh = 0;
      for (std::size_t p = 0; p < points.size(); ++p) {
        if (covered[p] || distance(points[p], center) > grid.ballRadius() * (1 + kRounding)) continue;
        covered[p] = true;
        ++fresh;
      }
      EXPECT_GE(fresh, 1U);
      EXPECT_LE(fresh, last) << "seed 17, trial " << trial;  // the greedy choice takes the fullest first
      last = fresh;
      metric += static_cast<double>(fresh * fresh);
      // Centres lie in the middle of cells.
      for (const Vec3d& axis : grid.axes) {
        const double at = dot(center - grid.corner, axis) / grid.edge - 0.5;
        EXPECT_NEAR(at, std::round(at), 1e-9);
      }
    }
    EXPECT_TRUE(std::ranges::all_of(covered, [](bool c) { return c; }));
    EXPECT_EQ(metric, cover.metric);
  }
}

TEST(DownhillSimplex, Valley_IsDescendedAndNeverLeftWorse) {
  const auto rosenbrock = [](const std::array<double, 2>& x) {
    return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
  };
  EXPECT_LT((downhillSimplex<2>({-1.2, 1}, {0.5, 0.5}, 300, rosenbrock).value), 1e-6);
  std::mt19937_64 engine(31);
  for (int trial = 0; trial < 50; ++trial) {
    const std::array<double, 2> start{test::uniform(engine, -2, 2), test::uniform(engine, -2, 2)};
    const auto steps = [](const std::array<double, 2>& x) { return std::floor(3 * x[0] * x[0] + 2 * x[1]); };
    EXPECT_LE((downhillSimplex<2>(start, {1, 1}, 20, steps).value), steps(start)) << "seed 31, trial " << trial;
  }
}

}  // namespace
}  // namespace cairn::builder::reductions_test
