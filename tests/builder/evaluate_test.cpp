// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/evaluate.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "builder_meshes.h"
#include "built_trees.h"
#include "evaluate/sampled_protrusion.h"
#include "evaluate/sphere_union.h"

namespace cairn::builder {
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

TEST(WastedVolume, OfBallsApartFromTheSolidIsThatOfTheirUnion) {
  const TriangleMesh far = test::moved(meshOf(cuboid({1, 1, 1}, 1)), [](const Vec3d& v) {
    return v + Vec3d{50, 0, 0};
  });
  const SignedDistance solid(far);
  // Two unit balls at distance 1 share a lens of volume pi (4 + 1)(2 - 1)^2 / 12.
  const double lens = kPi * 5 / 12;
  const double expected = 2 * ballVolume(1) - lens;
  const double total = 2 * ballVolume(1);
  EXPECT_NEAR(wastedVolume(solid, {{{0, 0, 0}, 1}, {{1, 0, 0}, 1}}, 1), expected, kShareTolerance * total);
  // The same ball many times is one ball.
  const std::vector<CutBall> same(7, CutBall{{0, 0, 0}, 2});
  EXPECT_NEAR(wastedVolume(solid, same, 1), ballVolume(2), 1e-9 * ballVolume(2));
}

TEST(WastedVolume, OfABallAroundACubeIsTheDifference) {
  const TriangleMesh cube = meshOf(cuboid({1, 1, 1}, 1));
  const SignedDistance solid(cube);
  EXPECT_NEAR(wastedVolume(solid, {{{0, 0, 0}, 1}}, 3), ballVolume(1) - 1, kShareTolerance * ballVolume(1));
  EXPECT_EQ(wastedVolume(solid, {{{0, 0, 0}, 0.5}}, 3), 0);
}

TEST(SampledProtrusion, OfABallAroundACubeIsNearAndBelowTheExactOne) {
  const TriangleMesh cube = meshOf(cuboid({1, 1, 1}, 1));
  const SignedDistance solid(cube);
  // 1000 even points: the nearest to a face's middle is less than 0.1 radian away, where the distance falls by 0.005.
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
}  // namespace cairn::builder
