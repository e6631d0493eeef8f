// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/truth/exact_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "distance_oracle.h"
#include "scenes/bodies/rock.h"
#include "scenes/figures/random.h"
#include "test_solids.h"

namespace cairn::scenes {
namespace {

/// Rounding of double precision over a few dozen operations on lengths of about 1.
constexpr double kRounding = 1e-12;
constexpr double kTolerance = 1e-4;

using Wide = test::DistanceOracle::Wide;

ExactSurface surfaceOf(const test::Solid& solid) {
  auto surface = ExactSurface::create(solid.vertices, solid.triangles);
  EXPECT_TRUE(surface) << surface.error().message;
  return std::move(surface).value();
}

Placement moved(const Vec3d& by) {
  return {Mat3d{}, by};
}

Placement turned(const Vec3d& axis, double angle, const Vec3d& by) {
  const btQuaternion q(btVector3(btScalar(axis.x), btScalar(axis.y), btScalar(axis.z)), btScalar(angle));
  // In double: Bullet's single-precision matrix would not be orthonormal enough.
  const double n =
      std::sqrt(double(q.x()) * q.x() + double(q.y()) * q.y() + double(q.z()) * q.z() + double(q.w()) * q.w());
  const double x = q.x() / n, y = q.y() / n, z = q.z() / n, w = q.w() / n;
  return {Mat3d{{Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                 Vec3d{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                 Vec3d{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}},
          by};
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
  const Placement below = turned({1, 0, 0}, std::numbers::pi / 4, {0, 0, 0});
  const Placement above = turned({0, 1, 0}, std::numbers::pi / 4, {0, 0, std::numbers::sqrt2 + 0.1});
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
        turned(random.direction(), random.uniform(0, 3), random.direction() * random.uniform(0.3, 0.9));
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

/// Distance of two segments in extended precision, by trying what can be nearest: two ends, an end and a foot, two
/// feet.
long double segmentDistance(const Wide& a, const Wide& b, const Wide& c, const Wide& d) {
  using test::DistanceOracle;
  long double best = std::min({DistanceOracle::toSegment(a, c, d), DistanceOracle::toSegment(b, c, d),
                               DistanceOracle::toSegment(c, a, b), DistanceOracle::toSegment(d, a, b)});
  const Wide u = b - a, v = d - c, w = c - a;
  const long double uu = lengthSq(u), vv = lengthSq(v), uv = dot(u, v), determinant = uu * vv - uv * uv;
  if (determinant <= 0) return best;
  const long double s = (dot(u, w) * vv - dot(v, w) * uv) / determinant;
  const long double t = (dot(u, w) * uv - dot(v, w) * uu) / determinant;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, length((a + u * s) - (c + v * t)));
  return best;
}

/// Whether the segment from p to q passes through the triangle, by the signs of volumes.
bool pierces(const Wide& p, const Wide& q, const std::array<Wide, 3>& t) {
  const auto volume = [](const Wide& a, const Wide& b, const Wide& c, const Wide& d) {
    return dot(cross(b - a, c - a), d - a);
  };
  if ((volume(t[0], t[1], t[2], p) > 0) == (volume(t[0], t[1], t[2], q) > 0)) return false;
  const bool first = volume(p, q, t[0], t[1]) > 0;
  return (volume(p, q, t[1], t[2]) > 0) == first && (volume(p, q, t[2], t[0]) > 0) == first;
}

/// Least distance of two meshes, 0 where they cross: every triangle against every other.
long double bruteForceGap(const builder::TriangleMesh& meshA, const builder::TriangleMesh& meshB,
                          const Placement& bFromA) {
  long double best = std::numeric_limits<long double>::infinity();
  for (std::uint32_t i = 0; i < meshA.triangles.size(); ++i)
    for (std::uint32_t j = 0; j < meshB.triangles.size(); ++j) {
      std::array<Wide, 3> a, b;
      for (int k = 0; k < 3; ++k) {
        a[k] = Wide(bFromA * meshA.corners(i)[k]);
        b[k] = Wide(meshB.corners(j)[k]);
      }
      for (int k = 0; k < 3; ++k) {
        if (pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a)) return 0;
        best = std::min({best, test::DistanceOracle::toTriangle(a[k], b[0], b[1], b[2]),
                         test::DistanceOracle::toTriangle(b[k], a[0], a[1], a[2])});
        for (int l = 0; l < 3; ++l) best = std::min(best, segmentDistance(a[k], a[(k + 1) % 3], b[l], b[(l + 1) % 3]));
      }
    }
  return best;
}

TEST(ExactCheck_TwoRocks, MeetAndGapAgreeWithBruteForce) {
  const builder::TriangleMesh meshA = generateRock({5, 1}), meshB = generateRock({6, 1});
  const auto a = ExactSurface::create(meshA.vertices, meshA.triangles),
             b = ExactSurface::create(meshB.vertices, meshB.triangles);
  ASSERT_TRUE(a && b);
  constexpr std::uint64_t kSeed = 17;
  Random random(kSeed);
  int meeting = 0;
  constexpr int kTrials = 40;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Placement placement =
        turned(random.direction(), random.uniform(0, 3), random.direction() * random.uniform(0.5, 1.1));
    const auto gap = static_cast<double>(bruteForceGap(meshA, meshB, placement));
    EXPECT_EQ(surfacesMeet(a.value(), b.value(), placement), gap == 0) << "seed " << kSeed << " trial " << trial;
    EXPECT_NEAR(surfaceDistance(a.value(), b.value(), placement), gap, kRounding)
        << "seed " << kSeed << " trial " << trial;
    meeting += gap == 0;
  }
  EXPECT_GT(meeting, kTrials / 5);
  EXPECT_LT(meeting, kTrials * 4 / 5);
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
}  // namespace cairn::scenes
