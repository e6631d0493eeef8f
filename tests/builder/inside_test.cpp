// SPDX-License-Identifier: GPL-3.0-or-later
//
// The inside tests of thesis appendix A, held to solid angles summed over all triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "builder_meshes.h"
#include "distance_oracle.h"
#include "surface/inside_by_closest_point.h"
#include "surface/inside_by_crossings.h"
#include "surface/inside_by_grid.h"
#include "surface/signed_distance.h"
#include "surface/triangle_in_cube.h"

namespace cairn::builder::inside_test {
namespace {

using test::uniform;

constexpr Vec3d kPitBottom{1.6, 0, 1};

/// A cube with a slanted pit: what lies below its bottom is in front of the face that hangs over it.
TriangleMesh slantedPit() {
  return test::moved(test::meshOf(test::cuboid({4, 4, 4}, 4)), [](const Vec3d& v) {
    return v == Vec3d{0, 0, 2} ? kPitBottom : v;
  });
}

std::vector<TriangleMesh> solids(std::uint64_t seed) {
  return {slantedPit(),
          test::lumpyBall(6, seed),
          test::torus(1, 0.3, 16, 8),
          test::meshOf(test::cuboid({2, 1, 0.4}, 3)),
          test::joined(test::meshOf(test::cuboid({2, 2, 2}, 2)), test::flipped(test::meshOf(test::ball(0.6, 4)))),
          test::moved(test::lumpyBall(4, seed), [](const Vec3d& v) {
            return Vec3d{v.x + 1e3, v.y * 1e-3, v.z - 1e3};
          })};
}

/// All over the box and around it, and near the surface at all scales down to where rounding begins.
std::vector<Vec3d> queriesFor(const TriangleMesh& mesh, std::mt19937_64& engine, int count) {
  const Bounds bounds = boundsOf(mesh);
  std::vector<Vec3d> queries;
  for (int i = 0; i < count; ++i) {
    Vec3d spread = test::randomPoint(engine) * 0.55;
    for (int axis = 0; axis < 3; ++axis) spread[axis] *= bounds.upper[axis] - bounds.lower[axis];
    queries.push_back(bounds.center() + spread);
    const auto c = mesh.corners(static_cast<std::uint32_t>(engine() % mesh.triangles.size()));
    const double scale = bounds.diagonal() * std::pow(10.0, uniform(engine, -8, -1));
    queries.push_back((c[0] + c[1] + c[2]) / 3 + test::randomPoint(engine) * scale);
    // Beside corners and edges, where the rules for faces do not help.
    queries.push_back(c[0] + test::randomPoint(engine) * scale);
    queries.push_back((c[0] + c[1]) * 0.5 + test::randomPoint(engine) * scale);
  }
  return queries;
}

/// Points this near the surface are passed over: the oracle's solid angles are summed in double.
constexpr double kTooNear = 1e-9;

/// Calls `expect(point, truth)` for many points of many solids.
template <class Expect>
void forPoints(const TriangleMesh& mesh, std::uint64_t seed, int count, const Expect& expect) {
  std::mt19937_64 engine(seed);
  const test::DistanceOracle oracle{mesh};
  for (const Vec3d& p : queriesFor(mesh, engine, count)) {
    if (oracle.distance(p) < kTooNear * boundsOf(mesh).diagonal()) continue;
    expect(p, oracle.windingNumber(p) > 0.5);
  }
}

constexpr std::uint64_t kSeeds[] = {501, 502, 503};
constexpr int kQueries = 150;

TEST(InsideByCrossings, MatchesSolidAngles) {
  for (const std::uint64_t seed : kSeeds)
    for (const TriangleMesh& mesh : solids(seed)) {
      const InsideByCrossings test(mesh);
      forPoints(mesh, seed, kQueries, [&](const Vec3d& p, bool inside) {
        ASSERT_EQ(test.inside(p), inside) << "seed " << seed << ", at " << p.x << ' ' << p.y << ' ' << p.z;
      });
    }
}

TEST(InsideByCrossings, CountsAsTriangleByTriangle) {
  for (const std::uint64_t seed : kSeeds) {
    const TriangleMesh mesh = test::lumpyBall(6, seed);
    const InsideByCrossings coarse(mesh, 1), fine(mesh, 40);  // one voxel holds every triangle
    std::mt19937_64 engine(seed);
    for (int i = 0; i < 2000; ++i) {
      const Vec3d p = test::randomPoint(engine) * 0.6, direction = test::randomPoint(engine);
      ASSERT_EQ(fine.crossings(p, direction), coarse.crossings(p, direction)) << "seed " << seed;
    }
  }
}

TEST(InsideByCrossings, RaysThroughCornersAreOutvoted) {
  // A ray through a corner or an edge counts both of the triangles there, or all, and mostly comes out even: 4 of 6
  // faces' diagonals, say. Points are placed so that the first ray of the first pair does just that.
  const TriangleMesh cube = test::meshOf(test::cuboid({2, 2, 2}, 4));
  const InsideByCrossings test(cube);
  int miscounted = 0;
  for (const Vec3d& corner : cube.vertices)
    for (const double far : {0.25, 0.5, 0.75, 1.0}) {
      const Vec3d p = corner - InsideByCrossings::firstDirection() * far;
      const bool inside = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1;
      if (inside) miscounted += test.crossings(p, InsideByCrossings::firstDirection()) % 2 == 0;
      ASSERT_EQ(test.inside(p), inside) << p.x << ' ' << p.y << ' ' << p.z;
    }
  EXPECT_GT(miscounted, 0);
}

TEST(InsideByClosestPoint, NeverCallsAPointInsideThatIsOutside) {
  for (const std::uint64_t seed : kSeeds)
    for (const TriangleMesh& mesh : solids(seed)) {
      const InsideByClosestPoint test(mesh);
      forPoints(mesh, seed, kQueries, [&](const Vec3d& p, bool inside) {
        if (test.inside(p)) {
          ASSERT_TRUE(inside) << "seed " << seed << ", at " << p.x << ' ' << p.y << ' ' << p.z;
        }
      });
    }
}

TEST(InsideByClosestPoint, IsWrongAtCornersOnly) {
  for (const std::uint64_t seed : kSeeds)
    for (const TriangleMesh& mesh : solids(seed)) {
      const InsideByClosestPoint test(mesh);
      forPoints(mesh, seed, kQueries, [&](const Vec3d& p, bool inside) {
        if (test.inside(p) == inside) return;
        ASSERT_LE(test.nearest(p).place.feature, Feature::corner2) << "seed " << seed;
      });
    }
}

TEST(InsideByClosestPoint, IsWrongBelowASlantedPit) {
  // The flaw the thesis describes, and the reason to prefer pseudonormals.
  const TriangleMesh mesh = slantedPit();
  const Vec3d below = kPitBottom + Vec3d{0.1, 0, -0.2};
  EXPECT_GT((test::DistanceOracle{mesh}.windingNumber(below)), 0.5);
  EXPECT_GT(SignedDistance(mesh).depth(below), 0);
  EXPECT_FALSE(InsideByClosestPoint(mesh).inside(below));
}

TEST(InsideByClosestPoint, FindsTheNearestTriangle) {
  for (const std::uint64_t seed : kSeeds)
    for (const TriangleMesh& mesh : solids(seed)) {
      const InsideByClosestPoint test(mesh);
      const SignedDistance solid(mesh);
      const test::DistanceOracle oracle{mesh};
      std::mt19937_64 engine(seed);
      for (const Vec3d& p : queriesFor(mesh, engine, kQueries))
        ASSERT_NEAR(length(test.nearest(p).place.offset), oracle.distance(p), solid.roundingBound(p))
            << "seed " << seed;
    }
}

TEST(InsideByGrid, IsAsRightAsTheTestItAsks) {
  for (const std::uint64_t seed : kSeeds)
    for (const TriangleMesh& mesh : solids(seed)) {
      const SignedDistance solid(mesh);
      for (const std::uint32_t perSide : {1U, 7U, 40U}) {
        const InsideByGrid test(
            mesh, [&](const Vec3d& p) { return solid.depth(p) > 0; }, perSide);
        forPoints(mesh, seed, kQueries, [&](const Vec3d& p, bool inside) {
          ASSERT_EQ(test.inside(p), inside) << "seed " << seed << ", " << perSide << " voxels";
        });
      }
    }
}

TEST(InsideByGrid, DecidesMoreTheFinerItIs) {
  const TriangleMesh mesh = test::lumpyBall(6, 1);
  const SignedDistance solid(mesh);
  const auto decided = [&](std::uint32_t perSide) {
    return InsideByGrid(
               mesh, [&](const Vec3d& p) { return solid.depth(p) > 0; }, perSide)
        .decidedFraction();
  };
  EXPECT_EQ(decided(1), 0);
  EXPECT_GT(decided(40), decided(10));
  EXPECT_GT(decided(80), 0.9);
}

TEST(TriangleGrid, ListsEveryTriangleOfAVoxel) {
  for (const std::uint64_t seed : kSeeds)
    for (const TriangleMesh& mesh : solids(seed)) {
      const TriangleGrid grid(mesh, 12);
      std::mt19937_64 engine(seed);
      for (int i = 0; i < 3000; ++i) {
        const auto t = static_cast<std::uint32_t>(engine() % mesh.triangles.size());
        const auto c = mesh.corners(t);
        const double root = std::sqrt(uniform(engine)), along = uniform(engine);
        const Vec3d p = c[0] * (1 - root) + c[1] * (root * (1 - along)) + c[2] * (root * along);
        const auto listed = grid.trianglesIn(grid.voxelOf(p));
        ASSERT_NE(std::find(listed.begin(), listed.end(), t), listed.end()) << "seed " << seed;
      }
    }
}

TEST(TriangleInCube, MatchesPointsOfTheTriangle) {
  for (const std::uint64_t seed : kSeeds) {
    std::mt19937_64 engine(seed);
    for (int i = 0; i < 300; ++i) {
      const Vec3d center = test::randomPoint(engine);
      const double half = uniform(engine, 0.05, 0.5);
      const std::array<Vec3d, 3> c{test::randomPoint(engine), test::randomPoint(engine), test::randomPoint(engine)};
      const bool meets = triangleMeetsCube(c, center, half);
      // The largest coordinate distance to the centre is convex over the triangle: a fine grid of points comes within
      // a step (at most 2.9 / 64 in any coordinate) of its least.
      double nearest = 1e300;
      for (int a = 0; a <= 64; ++a)
        for (int b = 0; a + b <= 64; ++b) {
          const Vec3d p = c[0] + (c[1] - c[0]) * (a / 64.0) + (c[2] - c[0]) * (b / 64.0) - center;
          nearest = std::min(nearest, std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
        }
      if (nearest <= half) {
        ASSERT_TRUE(meets) << "seed " << seed;
      }
      if (nearest > half + 2.9 / 64) {
        ASSERT_FALSE(meets) << "seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace cairn::builder::inside_test
