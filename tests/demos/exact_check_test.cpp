// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/truth/exact_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "brute_force_pairs.h"
#include "scenes/bodies/rock.h"
#include "scenes/figures/random.h"
#include "test_solids.h"

namespace cairn::scenes::exact_check_test {
namespace {

/// Rounding of double precision over a few dozen operations on lengths of about 1.
constexpr double kRounding = 1e-12;
constexpr double kTolerance = 1e-4;

ExactSurface surfaceOf(const test::Solid& solid) {
  auto surface = ExactSurface::create(solid.vertices, solid.triangles);
  EXPECT_TRUE(surface) << surface.error().message;
  return std::move(surface).value();
}

Placement moved(const Vec3d& by) {
  return {Mat3d{}, by};
}

TEST(ExactCheck_TwoCubes, PenetrationIsTheOverlapOfTheFaces) {
  const ExactSurface cube = surfaceOf(test::cuboid({1, 1, 1}, 1));
  // No corner is deeper than 0.05, so only the search over the faces can find 0.2.
  const Placement offset = moved({0.8, 0.1, 0.05});
  for (const Placement& placement : {offset, offset.inverse()}) {
    const double depth = penetration(cube, cube, placement, kTolerance);
    EXPECT_LE(depth, 0.2 + kRounding);
    EXPECT_GE(depth, 0.2 - kTolerance);
  }
  EXPECT_EQ(surfaceDistance(cube, cube, offset), 0);
}

TEST(ExactCheck_CrossedBars, PenetrationIsFoundWithoutAnyVertexInside) {
  const ExactSurface along = surfaceOf(test::cuboid({4, 1, 1}, 1)), across = surfaceOf(test::cuboid({1, 4, 1}, 1));
  const double depth = penetration(along, across, moved({0, 0, 0.9}), kTolerance);
  EXPECT_LE(depth, 0.1 + kRounding);
  EXPECT_GE(depth, 0.1 - kTolerance);
}

TEST(ExactCheck_TwoBalls, PenetrationAndGapDifferFromTheSpheresByTheSagittaOnly) {
  constexpr int kSubdivisions = 12;
  const test::Solid solid = test::ball(1, kSubdivisions);
  double inscribed = 1;  // the polyhedron contains this ball
  for (const auto& [a, b, c] : solid.triangles) {
    const Vec3d& p = solid.vertices[a];
    const Vec3d normal = normalized(cross(solid.vertices[b] - p, solid.vertices[c] - p));
    inscribed = std::min(inscribed, dot(normal, p));
  }
  const double sagitta = 1 - inscribed;
  const ExactSurface ball = surfaceOf(solid);
  Random random(7);
  for (int i = 0; i < 8; ++i) {
    const Vec3d direction = random.direction();
    const double depth = penetration(ball, ball, moved(direction * 1.5), kTolerance);
    EXPECT_LE(depth, 0.5 + kRounding);
    EXPECT_GE(depth, 0.5 - 2 * sagitta - kTolerance);
    const double gap = surfaceDistance(ball, ball, moved(direction * 2.3));
    EXPECT_GE(gap, 0.3 - kRounding);
    EXPECT_LE(gap, 0.3 + 2 * sagitta + kRounding);
  }
}

TEST(ExactCheck_NestedBall, DepthIsThatOfItsDeepestPoint) {
  const ExactSurface room = surfaceOf(test::cuboid({2, 2, 2}, 2)), ball = surfaceOf(test::ball(0.2, 4));
  const Placement roomFromBall = moved({0.5, 0, 0});
  const double depth = penetration(ball, room, roomFromBall, kTolerance);
  EXPECT_LE(depth, 0.7 + kRounding);
  EXPECT_GE(depth, 0.7 - kTolerance);
  EXPECT_EQ(penetration(room, ball, roomFromBall.inverse(), kTolerance), 0);
  EXPECT_NEAR(surfaceDistance(ball, room, roomFromBall), 0.3, kRounding);
}

TEST(ExactCheck_EdgeAcrossEdge, GapIsThatOfTheEdges) {
  const ExactSurface cube = surfaceOf(test::cuboid({1, 1, 1}, 1));
  const Placement below = test::turned({1, 0, 0}, std::numbers::pi / 4, {0, 0, 0});
  const Placement above = test::turned({0, 1, 0}, std::numbers::pi / 4, {0, 0, std::numbers::sqrt2 + 0.1});
  // Bullet's quaternion is rounded to its scalar: the edges turn by that much around the cubes' centres.
  const double rounding = 8 * std::numeric_limits<btScalar>::epsilon();
  EXPECT_NEAR(surfaceDistance(cube, cube, below.inverse() * above), 0.1, rounding);
  EXPECT_EQ(penetration(cube, cube, below.inverse() * above, kTolerance), 0);
}

/// Both answers for two rocks against dense sampling: a point of the sample is within `spacing` of any point of the
/// surface.
TEST(ExactCheck_TwoRocks, AgreesWithDenseSampling) {
  constexpr int kCells = 10;  // each triangle is cut into kCells^2
  const builder::TriangleMesh meshA = generateRock({3, 2}), meshB = generateRock({4, 2});
  const auto a = ExactSurface::create(meshA.vertices, meshA.triangles),
             b = ExactSurface::create(meshB.vertices, meshB.triangles);
  ASSERT_TRUE(a && b);
  double spacing = 0;
  for (std::uint32_t t = 0; t < meshA.triangles.size(); ++t) {
    const auto [p, q, r] = meshA.corners(t);
    spacing = std::max({spacing, distance(p, q) / kCells, distance(q, r) / kCells, distance(r, p) / kCells});
  }
  Random random(11);
  int penetrating = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Placement placement =
        test::turned(random.direction(), random.uniform(0, 3), random.direction() * random.uniform(0.3, 0.9));
    double sampledDepth = 0, sampledGap = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < meshA.triangles.size(); ++t) {
      const auto [p, q, r] = meshA.corners(t);
      for (int i = 0; i <= kCells; ++i)
        for (int j = 0; i + j <= kCells; ++j) {
          const Vec3d point = p + (q - p) * (double(i) / kCells) + (r - p) * (double(j) / kCells);
          const double depth = b.value().depth(placement * point);
          sampledDepth = std::max(sampledDepth, depth);
          sampledGap = std::min(sampledGap, std::abs(depth));
        }
    }
    const double depth = penetration(a.value(), b.value(), placement, kTolerance);
    EXPECT_GE(depth, sampledDepth - kTolerance) << "trial " << trial;
    EXPECT_LE(depth, sampledDepth + spacing) << "trial " << trial;
    const double gap = surfaceDistance(a.value(), b.value(), placement);
    EXPECT_LE(gap, sampledGap + kRounding) << "trial " << trial;
    EXPECT_GE(gap, sampledGap - spacing) << "trial " << trial;
    penetrating += depth > 0;
  }
  EXPECT_GT(penetrating, 2);
  EXPECT_LT(penetrating, 12);
}

TEST(ExactCheck_KnownDepth, IsKeptAndOnlyExceededByADeeperOne) {
  const ExactSurface cube = surfaceOf(test::cuboid({1, 1, 1}, 1));
  const Placement overlap = moved({0.8, 0.1, 0.05});  // 0.2 deep
  EXPECT_EQ(penetration(cube, cube, overlap, kTolerance, 0.3), 0.3);
  EXPECT_NEAR(penetration(cube, cube, overlap, kTolerance, 0.1), 0.2, kTolerance);
  EXPECT_NEAR(mutualPenetration(cube, cube, overlap, kTolerance, 0.1), 0.2, kTolerance);
}

TEST(ExactCheck_Nested, SurfacesDoNotMeetAndDistanceIgnoresTheSide) {
  const ExactSurface room = surfaceOf(test::cuboid({2, 2, 2}, 2)), ball = surfaceOf(test::ball(0.2, 4));
  EXPECT_FALSE(surfacesMeet(ball, room, moved({0.5, 0, 0})));
  EXPECT_TRUE(surfacesMeet(ball, room, moved({0.9, 0, 0})));
  EXPECT_NEAR(room.distanceTo({0.75, 0, 0}), 0.25, kRounding);
  EXPECT_NEAR(room.distanceTo({1.5, 0, 0}), 0.5, kRounding);
}

TEST(ExactCheck_Depth, IsSigned) {
  const ExactSurface cube = surfaceOf(test::cuboid({2, 2, 2}, 1));
  EXPECT_NEAR(cube.depth({0.75, 0, 0}), 0.25, kRounding);
  EXPECT_NEAR(cube.depth({2, 2, 1}), -std::numbers::sqrt2, kRounding);
}

TEST(ExactCheck_BadSurface, IsRefusedByName) {
  test::Solid open = test::cuboid({1, 1, 1}, 1);
  open.triangles.pop_back();
  const auto holed = ExactSurface::create(open.vertices, open.triangles);
  ASSERT_FALSE(holed);
  EXPECT_EQ(holed.error().message, "the surface is not closed");
  test::Solid flipped = test::cuboid({1, 1, 1}, 1);
  std::swap(flipped.triangles[5][0], flipped.triangles[5][1]);
  EXPECT_FALSE(ExactSurface::create(flipped.vertices, flipped.triangles));
  test::Solid dangling = test::cuboid({1, 1, 1}, 1);
  dangling.triangles[3][1] = 99;
  EXPECT_FALSE(ExactSurface::create(dangling.vertices, dangling.triangles));
}

}  // namespace
}  // namespace cairn::scenes::exact_check_test
