// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/bound.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "balls/enclosing_ball.h"
#include "bound/center_search.h"
#include "bound/outside_points.h"
#include "bound/surface_spread.h"
#include "builder_meshes.h"
#include "built_trees.h"
#include "cairn/builder/certify.h"
#include "certify/protrusion.h"
#include "distance_oracle.h"

namespace cairn::builder::bound_test {
namespace {

using test::cuboid;
using test::meshOf;

// Errors are tried in steps of this factor, so a bound may miss a reachable limit by one.
const double kStep = std::exp2(1.0 / 64);
// A cell of centres is at most 1/100 of the error, and the first outside points miss the offset surface by a fortieth:
// what one ball can hold is known to a few percent of the error.
constexpr double kSlack = 0.04;

BoundOptions fewPoints(std::uint32_t points = 150) {
  BoundOptions options;
  options.points = points;
  return options;
}

ErrorBound boundOf(const TriangleMesh& mesh, std::uint32_t spheres, const BoundOptions& options = fewPoints()) {
  return lowerErrorBound(mesh, spheres, options).value();
}

TEST(LowerBound, OfOneBallAroundACubeIsTheCircumscribedOne) {
  // A ball that holds the corners of the unit cube sticks out of one of two opposite faces by R - 1/2 at least.
  const double optimum = (std::sqrt(3.0) - 1) / 2;
  const ErrorBound bound = boundOf(meshOf(cuboid({1, 1, 1}, 2)), 1);
  EXPECT_LE(bound.error, optimum);
  EXPECT_GE(bound.error * kStep, (1 - kSlack) * optimum);
}

// A body that is small against the error has an offset surface like a sphere's, which outside points must not fill as
// densely as the parts' own.
TEST(LowerBound, OfOneBallAroundTinyPartsFarApart) {
  const TriangleMesh part = meshOf(cuboid({1e-6, 1e-6, 1e-6}, 1));
  const TriangleMesh mesh = test::joined(part, test::moved(part, [](const Vec3d& v) { return v + Vec3d{1, 0, 0}; }));
  // A ball that holds both has a radius of a half, and a point over its middle.
  const double optimum = std::sqrt(0.5);
  const ErrorBound bound = boundOf(mesh, 1, fewPoints(16));
  EXPECT_LE(bound.error, optimum * (1 + 1e-5));
  EXPECT_GE(bound.error * kStep, (1 - kSlack) * optimum);
}

TEST(LowerBound, OfOneBallAroundABallIsItsFacets) {
  // The vertices come in opposite pairs at distance 1, so a ball that holds them has R^2 >= 1 + |c|^2; and the faces
  // come in opposite pairs too, out of one of which it sticks by 1 less the face's distance.
  const TriangleMesh mesh = meshOf(test::ball(1, 2));
  double nearestFace = 1;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    nearestFace = std::min(nearestFace, dot(a, normalized(cross(b - a, c - a))));
  }
  const double optimum = 1 - nearestFace;
  const ErrorBound bound = boundOf(mesh, 1);
  EXPECT_LE(bound.error, optimum);
  EXPECT_GE(bound.error * kStep, (1 - kSlack) * optimum);
}

TEST(LowerBound, OfTwoBallsAroundTwoCubesFarApartIsThatOfOneAroundEach) {
  const TriangleMesh mesh = meshOf(test::twoCuboids({1, 1, 1}, {6, 0, 0}, 2));
  const double optimum = (std::sqrt(3.0) - 1) / 2;
  const ErrorBound bound = boundOf(mesh, 2);
  EXPECT_LE(bound.error, optimum);
  EXPECT_GE(bound.error * kStep, (1 - kSlack) * optimum);
  // One ball for both is as wide as both together: its middle lies in the gap, 2.5 from either, or beyond it.
  EXPECT_GT(boundOf(mesh, 1).error, 2);
}

TEST(LowerBound, IsNeverAboveTheErrorOfACoverWeCanBuild) {
  for (const std::uint64_t seed : {11, 12}) {
    std::mt19937_64 engine(seed);
    const TriangleMesh mesh = test::moved(test::lumpyBall(4, engine()), [&](const Vec3d& v) {
      return Vec3d{v.x + 3, 0.6 * v.y, 1.5 * v.z};
    });
    const SignedDistance solid(mesh);
    const EnclosingBall whole = smallestEnclosingBall(mesh.vertices);
    const double one = certifiedProtrusion(solid, whole.center, whole.radius, defaultProtrusionTolerance(solid)).upper;
    EXPECT_LE(boundOf(mesh, 1).error, one) << "seed " << seed;
    constexpr std::uint32_t kChildren = 6;
    const ErrorBound bound = boundOf(mesh, kChildren);
    for (const Method method : {Method::expand, Method::combined}) {
      BuildOptions options;
      options.method = method;
      options.branching = kChildren;
      options.depth = 1;
      options.samples = 500;
      const SphereTree tree = buildTree(mesh, options).value();
      const LevelCertificate level = certify(tree, mesh).value().levels.at(1);
      ASSERT_TRUE(level.coverageProven);
      ASSERT_LE(level.spheres, kChildren);
      EXPECT_LE(bound.error, level.maxProtrusion) << "seed " << seed;
      EXPECT_GT(bound.error, 0.3 * level.maxProtrusion) << "seed " << seed;
    }
  }
}

std::uint64_t totalOf(const ErrorBound& bound) {
  std::uint64_t total = 0;
  for (const WeightedPoint& p : bound.weights) total += p.weight;
  return total;
}

std::uint64_t loadOf(const ErrorBound& bound, const Vec3d& center, double radius) {
  std::uint64_t load = 0;
  for (const WeightedPoint& p : bound.weights) load += distance(p.point, center) <= radius ? p.weight : 0;
  return load;
}

/// The largest radius found, by bisection, whose ball is certified to protrude by no more than `error`.
double admissibleRadius(const SignedDistance& solid, const Vec3d& center, double error) {
  double fits = 0, tooLarge = solid.bounds().diagonal();
  for (int i = 0; i < 12; ++i) {
    const double radius = (fits + tooLarge) / 2;
    const bool fit = certifiedProtrusion(solid, center, radius, {0.001, 0.001 * error, 2000}).upper <= error;
    (fit ? fits : tooLarge) = radius;
  }
  return fits;
}

TEST(LowerBound, NoAdmissibleBallHoldsMoreThanTheProofSays) {
  constexpr std::uint64_t kSeed = 5;
  std::mt19937_64 engine(kSeed);
  const TriangleMesh mesh = test::moved(test::lumpyBall(4, 8), [](const Vec3d& v) { return v + Vec3d{0, 7, 0}; });
  const SignedDistance solid(mesh);
  const ErrorBound bound = boundOf(mesh, 5);
  ASSERT_GT(bound.error, 0);
  ASSERT_GT(totalOf(bound), 5 * bound.mostInOneBall);
  std::uint64_t heaviest = 0;
  for (int start = 0; start < 40; ++start) {
    // Uphill on what the largest admissible ball around the centre holds, in random steps.
    Vec3d center = Vec3d{0, 7, 0} + test::randomPoint(engine) * 0.8;
    std::uint64_t best = loadOf(bound, center, admissibleRadius(solid, center, bound.error));
    for (double step = 0.2; step > 0.01; step *= 0.85) {
      const Vec3d next = center + test::randomPoint(engine) * step;
      const std::uint64_t load = loadOf(bound, next, admissibleRadius(solid, next, bound.error));
      if (load < best) continue;
      best = load;
      center = next;
    }
    heaviest = std::max(heaviest, best);
    ASSERT_LE(best, bound.mostInOneBall) << "seed " << kSeed;
  }
  // The search comes near enough for the bound to be tried in earnest.
  EXPECT_GT(static_cast<double>(heaviest), 0.8 * static_cast<double>(bound.mostInOneBall));
}

TEST(LowerBound, FallsWithTheNumberOfSpheres) {
  const TriangleMesh mesh = test::torus(1, 0.35, 12, 8);
  double last = std::numeric_limits<double>::infinity();
  for (const std::uint32_t spheres : {1U, 2U, 6U}) {
    const double error = boundOf(mesh, spheres).error;
    EXPECT_LE(error, last) << spheres;
    EXPECT_GT(error, 0) << spheres;
    last = error;
  }
}

TEST(LowerBound, ScalesWithTheMeshAndIgnoresThreads) {
  const TriangleMesh mesh = test::lumpyBall(3, 5);
  const TriangleMesh scaled = test::moved(mesh, [](const Vec3d& v) { return v * 1024.0; });  // exact in binary
  std::vector<ErrorBound> bounds;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    bounds.push_back(boundOf(mesh, 4));
  }
  ASSERT_EQ(bounds[0].error, bounds[1].error);
  ASSERT_EQ(bounds[0].weights.size(), bounds[1].weights.size());
  for (std::size_t i = 0; i < bounds[0].weights.size(); ++i) {
    EXPECT_EQ(bounds[0].weights[i].point, bounds[1].weights[i].point);
    EXPECT_EQ(bounds[0].weights[i].weight, bounds[1].weights[i].weight);
  }
  EXPECT_NEAR(boundOf(scaled, 4).error / 1024, bounds[0].error, bounds[0].error * 2 * (kStep - 1));
}

TEST(LowerBound, RefusesWhatIsOutOfRangeAndStopsWhenToldTo) {
  const TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
  EXPECT_NE(lowerErrorBound(mesh, 0).error().message.find("0 spheres"), std::string::npos);
  EXPECT_NE(lowerErrorBound(mesh, 1, fewPoints(7)).error().message.find("7 points"), std::string::npos);
  for (const double seconds : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    BoundOptions options;
    options.seconds = seconds;
    EXPECT_NE(lowerErrorBound(mesh, 1, options).error().message.find("no time to search in"), std::string::npos);
  }
  const auto cancelled = lowerErrorBound(mesh, 8, fewPoints(), [](std::string_view, double) { return false; });
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().message, kCancelled);
}

TEST(LowerBound, IsThereEarlyAndHoldsWhenTimeIsUp) {
  const TriangleMesh mesh = test::lumpyBall(5, 4);
  const SignedDistance solid(mesh);
  BuildOptions build;
  build.method = Method::adaptive;
  build.branching = 8;
  build.depth = 1;
  const SphereTree tree = buildTree(mesh, build).value();
  const double reached = certify(tree, mesh).value().levels.at(1).maxProtrusion;
  BoundOptions options;
  options.points = 20'000;  // far more than the time is enough for
  ErrorBound bound;
  // Three seconds are enough for a core of its own; a crowded machine gets more.
  for (options.seconds = 3; bound.error < 0.2 * reached && *options.seconds < 300;
       options.seconds = 4 * *options.seconds) {
    const auto start = std::chrono::steady_clock::now();
    bound = lowerErrorBound(mesh, 8, options).value();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_TRUE(bound.stoppedByTime);
    EXPECT_LT(seconds, 1.2 * *options.seconds + 1);
  }
  EXPECT_LE(bound.error, reached);
  EXPECT_GT(bound.error, 0.2 * reached);
  EXPECT_GT(totalOf(bound), 8 * bound.mostInOneBall);
  EXPECT_FALSE(boundOf(meshOf(cuboid({1, 1, 1}, 1)), 1, fewPoints(60)).stoppedByTime);
}

TEST(LowerBound, SaysOnTheWayWhatIsProvedAndThatNeverFalls) {
  double proved = 0, share = 0;
  const auto listen = [&](std::string_view stage, double fraction) {
    double percent = 0;
    if (std::sscanf(std::string(stage).c_str(), "bounding, %lf %% proved", &percent) == 1) {
      EXPECT_GE(percent, proved);
      proved = percent;
    }
    EXPECT_GE(fraction, share);
    EXPECT_LE(fraction, 1);
    share = fraction;
    return true;
  };
  const TriangleMesh mesh = test::lumpyBall(3, 5);
  const ErrorBound bound = lowerErrorBound(mesh, 4, fewPoints(250), listen).value();
  EXPECT_GT(proved, 0);
  EXPECT_LE(proved, 100 * bound.error / boundsOf(mesh).diagonal() * (1 + 1e-3));
}

// A search that was cut short has not seen all centres, so it must not pass for a proof.
TEST(CenterSearch, FindsNothingOutWhenStopped) {
  const TriangleMesh mesh = test::lumpyBall(3, 5);
  const SignedDistance solid(mesh);
  const std::vector<Vec3d> points = spreadOverSurface(mesh, 100);
  const std::vector<std::uint64_t> weights(points.size(), 1);
  const std::vector<Vec3d> outside = outsidePoints(solid, 0.1, 0.1);
  const auto heavier = [&](int callsOfConstruction, int callsOfSearch) {
    std::atomic<int> construction = callsOfConstruction, searching = callsOfSearch;
    const CenterSearch search(points, outside, 3, 1e-12, [&] { return construction-- > 0; });
    return search.heavierThan(weights, 200, 0.001, [&] { return searching-- > 0; });
  };
  constexpr int kMany = 1 << 30;
  const auto whole = heavier(kMany, kMany);
  ASSERT_TRUE(whole.has_value());
  EXPECT_TRUE(whole->empty());  // 200 of a weight of 100
  for (const int calls : {0, 1, 10}) EXPECT_FALSE(heavier(calls, kMany).has_value()) << calls;
  std::atomic<int> searching = 5;
  const CenterSearch search(points, outside, 3, 1e-12, [] { return true; });
  EXPECT_FALSE(search.heavierThan(weights, 10, 0.001, [&] { return searching-- > 0; }).has_value());
}

TEST(OutsidePoints, AreFartherThanTheErrorAndCloseToItEverywhere) {
  constexpr std::uint64_t kSeed = 3;
  std::mt19937_64 engine(kSeed);
  const TriangleMesh mesh = test::lumpyBall(3, 5);
  const SignedDistance solid(mesh);
  const test::DistanceOracle oracle{mesh};
  const double error = 0.1, spacing = 0.1;
  const std::vector<Vec3d> outside = outsidePoints(solid, error, spacing);
  for (const Vec3d& q : outside) {
    const double depth = oracle.depth(q);
    ASSERT_LT(depth, -error);
    ASSERT_NEAR(depth, -error, 1e-9);
  }
  for (int i = 0; i < 300; ++i) {
    // Any place at that distance has one nearby: the grid point next to it was drawn along less than two spacings.
    Vec3d place = normalized(test::randomPoint(engine)) * 2.0;
    const SurfacePoint near = solid.closest(place);
    place = near.point + (place - near.point) * (error / near.distance);
    double gap = 1;
    for (const Vec3d& q : outside) gap = std::min(gap, distance(q, place));
    ASSERT_LT(gap, 2.5 * spacing) << "seed " << kSeed;
  }
}

TEST(SurfaceSpread, IsOnTheSurfaceAndLeavesNoLargeGap) {
  const TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
  const SignedDistance solid(mesh);
  const std::vector<Vec3d> points = spreadOverSurface(mesh, 200);
  ASSERT_EQ(points.size(), 200U);
  for (const Vec3d& p : points) EXPECT_LE(std::abs(solid.depth(p)), solid.roundingBound(p));
  double smallest = 1;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) smallest = std::min(smallest, distance(points[i], points[j]));
  // Points on a square grid would be sqrt(6 / 200) apart.
  EXPECT_GT(smallest, 0.5 * std::sqrt(6.0 / 200));
}

}  // namespace
}  // namespace cairn::builder::bound_test
