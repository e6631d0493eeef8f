// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/evaluate.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "builder_meshes.h"
#include "built_trees.h"
#include "distance_oracle.h"
#include "evaluate/sampled_protrusion.h"
#include "evaluate/uncovered_area.h"
#include "evaluate/volumes.h"

namespace cairn::builder::evaluate_test {
namespace {

using test::cuboid;
using test::meshOf;

constexpr double kPi = std::numbers::pi;
// Five standard errors of a share estimated from 100 000 samples, at its widest (share 1/2).
constexpr double kShareTolerance = 5 * 0.5 / 316.2;

double ballVolume(double radius) {
  return 4.0 / 3.0 * kPi * radius * radius * radius;
}

TEST(UncoveredArea, OfACubeInTheMiddleOfABallIsThatOutsideADiscPerFace) {
  const TriangleMesh cube = meshOf(cuboid({2, 2, 2}, 3));
  for (const double radius : {0.5, 1.1, 1.3, 1.4, 1.8}) {
    const double disc = radius > 1 ? kPi * (radius * radius - 1) / 4 : 0;
    const double expected = radius > std::sqrt(3.0) ? 0 : 1 - disc;
    EXPECT_NEAR(uncoveredAreaFraction(cube, {{{0, 0, 0}, radius}}, 1), expected, kShareTolerance) << radius;
  }
  EXPECT_EQ(uncoveredAreaFraction(cube, {{{0, 0, 0}, 1.75}}, 1), 0);
  EXPECT_EQ(uncoveredAreaFraction(cube, {{{0, 0, 0}, 0.99}}, 1), 1);
}

/// Balls, a solid and what of each lies outside the other.
struct Volumes {
  Volumes(const TriangleMesh& mesh, const std::vector<CutBall>& balls, std::uint64_t seed) {
    const SolidLines solid(mesh);
    const BallLines ballLines(balls);
    wasted = wastedVolume(solid, ballLines, seed);
    uncovered = uncoveredVolume(solid, ballLines, seed);
  }
  VolumeEstimate wasted, uncovered;
};

/// `box`: volume of the box the lines cross. A length between 0 and the box's height has a standard deviation of half
/// of that at most, and 100 000 lines 316 times less: MISER must not do worse.
void expectVolume(const VolumeEstimate& estimate, double truth, double box) {
  // Chance of a miss below 1e-6 for normal errors; 1e-12 for integrals without any variance.
  EXPECT_NEAR(estimate.value, truth, 5 * estimate.standardError + 1e-12 * truth);
  EXPECT_LE(estimate.standardError, box / 2 / 316.2);
}

TEST(WastedVolume, OfBallsApartFromTheSolidIsThatOfTheirUnion) {
  const TriangleMesh far = test::moved(meshOf(cuboid({1, 1, 1}, 1)), [](const Vec3d& v) {
    return v + Vec3d{50, 0, 0};
  });
  // Two unit balls at distance 1 share a lens of volume pi (4 + 1)(2 - 1)^2 / 12.
  const double lens = kPi * 5 / 12;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const Volumes apart(far, {{{0, 0, 0}, 1}, {{1, 0, 0}, 1}}, seed);
    expectVolume(apart.wasted, 2 * ballVolume(1) - lens, 3 * 2 * 2);
    expectVolume(apart.uncovered, 1, 1);
    // The same ball many times is one ball.
    expectVolume(Volumes(far, std::vector<CutBall>(7, CutBall{{0, 0, 0}, 2}), seed).wasted, ballVolume(2), 4 * 4 * 4);
  }
}

TEST(WastedVolume, OfABallAroundACubeIsTheDifference) {
  const TriangleMesh cube = meshOf(cuboid({1, 1, 1}, 1));
  expectVolume(Volumes(cube, {{{0, 0, 0}, 1}}, 3).wasted, ballVolume(1) - 1, 2 * 2 * 2);
  EXPECT_EQ(Volumes(cube, {{{0, 0, 0}, 1}}, 3).uncovered.value, 0);
  EXPECT_EQ(Volumes(cube, {{{0, 0, 0}, 0.5}}, 3).wasted.value, 0);
  expectVolume(Volumes(cube, {{{0, 0, 0}, 0.5}}, 3).uncovered, 1 - ballVolume(0.5), 1);
}

/// Hit or miss in the box of everything (Eq. 7.1 and 7.2), with brute-force insides: shares no code with the lines.
void expectSameAsHitOrMiss(const TriangleMesh& mesh, const std::vector<CutBall>& balls, std::uint64_t seed) {
  constexpr int kPoints = 20'000;
  const test::DistanceOracle oracle{mesh};
  std::mt19937_64 engine(seed);
  int wasted = 0, uncovered = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3d p = test::randomPoint(engine) * 2.0;
    const bool inSolid = oracle.windingNumber(p) > 0.5;
    const bool inBalls = std::any_of(balls.begin(), balls.end(), [&](const CutBall& b) { return b.contains(p); });
    wasted += inBalls && !inSolid;
    uncovered += inSolid && !inBalls;
  }
  constexpr double kBox = 64, kError = kBox * 0.5 / 141.4;  // of a share at its widest, 1/2, over 20 000 points
  const Volumes volumes(mesh, balls, seed);
  EXPECT_NEAR(volumes.wasted.value, kBox * wasted / kPoints, 5 * kError) << "seed " << seed;
  EXPECT_NEAR(volumes.uncovered.value, kBox * uncovered / kPoints, 5 * kError) << "seed " << seed;
}

TEST(Volumes, MatchHitOrMissForRandomBalls) {
  for (std::uint64_t seed = 11; seed <= 13; ++seed) {
    std::mt19937_64 engine(seed);
    std::vector<CutBall> balls(12);
    for (CutBall& b : balls) b = {test::randomPoint(engine), test::uniform(engine, 0.1, 0.9)};
    expectSameAsHitOrMiss(test::lumpyBall(4, seed), balls, seed);
    expectSameAsHitOrMiss(test::torus(1, 0.5, 12, 8), balls, seed);
  }
}

TEST(Volumes, OfManySeedsScatterAsTheStandardErrorSays) {
  const TriangleMesh mesh = test::lumpyBall(5, 2);
  const SolidLines solid(mesh);
  const std::vector<CutBall> cut{{{0, 0, 0}, 0.9}, {{0.3, 0.2, 0}, 0.8}};
  const BallLines balls(cut);
  constexpr int kRuns = 40;
  double sum = 0, sumSq = 0, stated = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const VolumeEstimate estimate = wastedVolume(solid, balls, seed);
    sum += estimate.value, sumSq += estimate.value * estimate.value, stated += estimate.standardError / kRuns;
  }
  const double scatter = std::sqrt((sumSq - sum * sum / kRuns) / (kRuns - 1));
  // The scatter of 40 runs is itself known to within a ninth (one standard error); MISER's own estimate to less.
  EXPECT_GT(scatter, stated / 2);
  EXPECT_LT(scatter, stated * 2);
}

TEST(PlaneBuckets, ListEveryRectangleThatHoldsAPoint) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    std::mt19937_64 engine(seed);
    // From all alike to some that cover nearly everything.
    std::vector<Rectangle> rectangles(400);
    for (Rectangle& r : rectangles) {
      const double width = std::pow(10.0, test::uniform(engine, -2.0, -2.0 + static_cast<double>(seed) / 4));
      for (int axis = 0; axis < 2; ++axis) {
        r.lower[axis] = test::uniform(engine, -1, 1);
        r.upper[axis] = r.lower[axis] + width;
      }
    }
    const PlaneBuckets buckets(rectangles);
    EXPECT_LE(buckets.entries(), PlaneBuckets::kMaxPerRectangle * rectangles.size());
    for (int i = 0; i < 500; ++i) {
      // Every other point on a corner.
      const Rectangle& corner = rectangles[engine() % rectangles.size()];
      const double x = i % 2 == 0 ? corner.upper[0] : test::uniform(engine, -1.5, 2.5);
      const double y = i % 2 == 0 ? corner.lower[1] : test::uniform(engine, -1.5, 2.5);
      const auto listed = buckets.at(x, y);
      for (std::uint32_t r = 0; r < rectangles.size(); ++r) {
        const auto& [lower, upper] = rectangles[r];
        if (lower[0] <= x && x <= upper[0] && lower[1] <= y && y <= upper[1]) {
          ASSERT_TRUE(std::binary_search(listed.begin(), listed.end(), r)) << "seed " << seed;
        }
      }
    }
  }
}

TEST(SolidLines, MeetCornersAndEdgesLikeAnyOtherPlace) {
  // All corners, edges and faces of this cube and its diagonals lie over points of the grid.
  const TriangleMesh cube = meshOf(cuboid({2, 2, 2}, 4));
  const SolidLines solid(cube);
  LineParts parts;
  for (double x = -0.875; x < 1; x += 0.125)
    for (double y = -0.875; y < 1; y += 0.125) {
      solid.partsAt(x, y, parts);
      ASSERT_EQ(parts.size(), 1U) << x << ' ' << y;
      EXPECT_EQ(parts[0].begin, -1);
      EXPECT_EQ(parts[0].end, 1);
    }
  solid.partsAt(1.5, 0, parts);
  EXPECT_TRUE(parts.empty());
}

TEST(SolidLines, EndWhereTheInsideDoes) {
  const TriangleMesh mesh = test::torus(1, 0.4, 12, 7);
  const SolidLines solid(mesh);
  const test::DistanceOracle oracle{mesh};
  constexpr std::uint64_t kSeed = 5;
  std::mt19937_64 engine(kSeed);
  LineParts parts;
  for (int i = 0; i < 3000; ++i) {
    const Vec3d p = test::randomPoint(engine) * 1.5;
    solid.partsAt(p.x, p.y, parts);
    const bool inside =
        std::any_of(parts.begin(), parts.end(), [&](const LinePart& l) { return l.begin <= p.z && p.z <= l.end; });
    if (std::abs(oracle.distance(p)) > 1e-9) {
      ASSERT_EQ(inside, oracle.windingNumber(p) > 0.5) << "seed " << kSeed;
    }
  }
}

TEST(UncoveredDepth, OfABallInACubeIsThatOfItsOwnRim) {
  const TriangleMesh cube = meshOf(cuboid({2, 2, 2}, 1));
  const SignedDistance distance(cube);
  const SolidLines solid(cube);
  const std::vector<CutBall> none, around{{{0, 0, 0}, 2}}, corner{{{1, 1, 1}, 1}};
  EXPECT_EQ(uncoveredDepth(distance, solid, BallLines(around), 1).max, 0);
  // Without balls: the middle, depth 1, is the deepest; the mean square over the cube is 1/10 (3 (1-t)^2 t^2 summed).
  const UncoveredDepth all = uncoveredDepth(distance, solid, BallLines(none), 1);
  EXPECT_LE(all.max, 1);
  EXPECT_GT(all.max, 0.95);
  EXPECT_NEAR(all.rms, std::sqrt(0.1), 0.01);
  // The ball in the corner reaches the middle's surroundings at no place.
  EXPECT_GT(uncoveredDepth(distance, solid, BallLines(corner), 1).max, 0.95);
}

TEST(SampledProtrusion, OfABallAroundACubeIsNearAndBelowTheExactOne) {
  const TriangleMesh cube = meshOf(cuboid({1, 1, 1}, 1));
  const SignedDistance solid(cube);
  // A sample is less than 0.1 radian from the one farthest out, over a face's middle, where the distance falls by
  // 0.005.
  const double sampled = sampledProtrusion(solid, {0, 0, 0}, 1);
  EXPECT_LE(sampled, 0.5);
  EXPECT_GE(sampled, 0.495);
  EXPECT_EQ(sampledProtrusion(solid, {0, 0, 0}, 0.4), 0);
}

std::vector<LevelFit> fitOf(const SphereTree& tree, const TriangleMesh& mesh, Sampling sampling,
                            std::uint64_t seed = 1) {
  return evaluate(tree, mesh, certify(tree, mesh).value(), sampling, seed).value();
}

TEST(Evaluate, SampledNeverExceedsCertified) {
  for (const TriangleMesh& mesh : {test::lumpyBall(6, 5), test::torus(1, 0.3, 16, 8), meshOf(cuboid({1, 2, 3}, 1))}) {
    const SphereTree tree = test::quickTree(mesh);
    const std::vector<LevelFit> fits = fitOf(tree, mesh, Sampling::full);
    ASSERT_EQ(fits.size(), 2U);
    for (const LevelFit& fit : fits) {
      EXPECT_LE(fit.sampledMaxFraction, fit.certifiedMaxFraction);
      EXPECT_LE(fit.sampledRmsFraction, fit.certifiedRmsFraction);
      EXPECT_GT(fit.sampledMaxFraction, 0.8 * fit.certifiedMaxFraction);
      EXPECT_EQ(fit.uncoveredAreaFraction, 0);
      EXPECT_GE(fit.sampledVarianceFractionSquared, 0);
      EXPECT_LE(fit.sampledVarianceFractionSquared, fit.sampledRmsFraction * fit.sampledRmsFraction);
      EXPECT_LE(fit.uncoveredDepthRmsFraction, fit.uncoveredDepthMaxFraction);
      EXPECT_TRUE(fit.coverageProven);
    }
    EXPECT_EQ(fits[0].level, 1U);
    EXPECT_EQ(fits[1].spheres, tree.levelCut(2).size());
    EXPECT_LT(fits[1].wastedVolumeFraction, fits[0].wastedVolumeFraction);
  }
}

TEST(Evaluate, FractionsDoNotDependOnTheUnit) {
  const TriangleMesh mesh = test::lumpyBall(4, 5);
  const TriangleMesh scaled = test::moved(mesh, [](const Vec3d& v) { return v * 1024.0; });  // exact in binary
  const LevelFit a = fitOf(test::quickTree(mesh), mesh, Sampling::full).back();
  const LevelFit b = fitOf(test::quickTree(scaled), scaled, Sampling::full).back();
  EXPECT_NEAR(a.certifiedMaxFraction, b.certifiedMaxFraction, 1e-9);
  EXPECT_NEAR(a.sampledRmsFraction, b.sampledRmsFraction, 1e-9);
  EXPECT_NEAR(a.wastedVolumeFraction, b.wastedVolumeFraction, 1e-3 * a.wastedVolumeFraction);
}

TEST(Evaluate, HasTheSameBitsForAnyNumberOfThreads) {
  const TriangleMesh mesh = test::lumpyBall(6, 5);
  const SphereTree tree = test::quickTree(mesh);
  std::vector<LevelFit> results;
  for (const std::size_t threads : {1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(fitOf(tree, mesh, Sampling::full).back());
  }
  for (const LevelFit& fit : results) {
    EXPECT_EQ(fit.certifiedRmsFraction, results[0].certifiedRmsFraction);
    EXPECT_EQ(fit.sampledRmsFraction, results[0].sampledRmsFraction);
    EXPECT_EQ(fit.uncoveredAreaFraction, results[0].uncoveredAreaFraction);
    EXPECT_EQ(fit.wastedVolumeFraction, results[0].wastedVolumeFraction);
    EXPECT_EQ(fit.uncoveredVolumeFraction, results[0].uncoveredVolumeFraction);
    EXPECT_EQ(fit.uncoveredDepthRmsFraction, results[0].uncoveredDepthRmsFraction);
  }
  EXPECT_NE(fitOf(tree, mesh, Sampling::full, 2).back().wastedVolumeFraction, results[0].wastedVolumeFraction);
}

TEST(Evaluate, StopsWhenToldTo) {
  const TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
  const SphereTree tree = test::quickTree(mesh);
  const auto result = evaluate(tree, mesh, certify(tree, mesh).value(), Sampling::full, 1,
                               [](std::string_view, double fraction) { return fraction < 0.3; });
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().message, kCancelled);
}

}  // namespace
}  // namespace cairn::builder::evaluate_test
