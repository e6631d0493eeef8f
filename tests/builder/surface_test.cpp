// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "builder_meshes.h"
#include "distance_oracle.h"
#include "surface/mass_properties.h"
#include "surface/signed_distance.h"

namespace cairn::builder::surface_test {
namespace {

using test::uniform;

constexpr std::uint64_t kSeed = 20240607;

Vec3d pointOnSurface(const TriangleMesh& mesh, std::mt19937_64& engine) {
  const auto c = mesh.corners(static_cast<std::uint32_t>(engine() % mesh.triangles.size()));
  const double root = std::sqrt(uniform(engine)), along = uniform(engine);
  return c[0] * (1 - root) + c[1] * (root * (1 - along)) + c[2] * (root * along);
}

/// Points near the surface at all scales, all over the box, far away, and exactly on vertices and middles of edges.
std::vector<Vec3d> queriesFor(const TriangleMesh& mesh, std::size_t count) {
  std::mt19937_64 engine(kSeed);
  const Bounds bounds = boundsOf(mesh);
  std::vector<Vec3d> queries;
  for (std::size_t i = 0; i < count; ++i) {
    const double scale = bounds.diagonal() * std::pow(10.0, uniform(engine, -12, 2));
    queries.push_back(pointOnSurface(mesh, engine) + test::randomPoint(engine) * scale);
    queries.push_back(bounds.center() + test::randomPoint(engine) * bounds.diagonal());
    const auto c = mesh.corners(static_cast<std::uint32_t>(engine() % mesh.triangles.size()));
    queries.push_back(c[0]);
    queries.push_back((c[0] + c[1]) * 0.5);
  }
  return queries;
}

void expectMatchesOracle(const TriangleMesh& mesh, std::size_t count) {
  const SignedDistance solid(mesh);
  const test::DistanceOracle oracle{mesh};
  for (const Vec3d& q : queriesFor(mesh, count)) {
    const SignedDistance::Answer answer = solid.query(q);
    const double bound = solid.roundingBound(q);
    const double truth = oracle.distance(q);
    ASSERT_NEAR(answer.nearest.distance, truth, bound) << "seed " << kSeed;
    ASSERT_EQ(std::abs(answer.depth), answer.nearest.distance);
    ASSERT_NEAR(distance(answer.nearest.point, q), truth, 2 * bound);
    const auto c = mesh.corners(answer.nearest.triangle);
    using Wide = test::DistanceOracle::Wide;
    ASSERT_LE(test::DistanceOracle::toTriangle(Wide(answer.nearest.point), Wide(c[0]), Wide(c[1]), Wide(c[2])),
              2 * bound);
    // On the surface, within rounding of the oracle's solid angles, the sign means nothing.
    if (truth > 1e-9 * boundsOf(mesh).diagonal()) {
      ASSERT_EQ(answer.depth > 0, oracle.windingNumber(q) > 0.5)
          << "seed " << kSeed << ", at " << q.x << ' ' << q.y << ' ' << q.z;
    }
  }
}

TEST(SignedDistance, MatchesBruteForceOnACube) {
  expectMatchesOracle(test::meshOf(test::cuboid({1, 1, 1}, 1)), 500);
}

TEST(SignedDistance, MatchesBruteForceOnAConcaveBody) {
  expectMatchesOracle(test::lumpyBall(12, kSeed), 300);
}

/// A corner of a cube with its apex lowered to `height`: three of its edges are as sharp as it is flat.
TriangleMesh flatCorner(double height) {
  return test::meshOf(
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
}

// Above the sharp edge its two normals have nothing in common with the way there but rounding.
TEST(SignedDistance, KnowsTheSideAboveEdgesSharperThanRounding) {
  for (const double height : {1e-6, 1e-10, 1e-14, 1e-15}) {
    const TriangleMesh mesh = flatCorner(height);
    const SignedDistance solid(mesh);
    std::mt19937_64 engine(kSeed);
    for (int i = 0; i < 2000; ++i) {
      const double along = uniform(engine), up = uniform(engine, -1, 1);
      ASSERT_LE(solid.depth({along, 1 - along, up}), height) << height << ", seed " << kSeed;
      ASSERT_LE(solid.depth({along, 0, up}), height) << height << ", seed " << kSeed;
      ASSERT_LE(solid.depth({1, 0, up}), height) << height << ", seed " << kSeed;
    }
  }
}

TEST(SignedDistance, MatchesBruteForceOnATorus) {
  expectMatchesOracle(test::torus(1, 0.3, 24, 12), 300);
}

TEST(SignedDistance, MatchesBruteForceOnSeveralShellsAndACavity) {
  const TriangleMesh shells =
      test::joined(test::meshOf(test::twoCuboids({1, 1, 1}, {3, 0, 0}, 2)),
                   test::flipped(test::moved(test::meshOf(test::ball(0.3, 4)), [](const Vec3d& v) {
                     return v + Vec3d{1.5, 0, 0};
                   })));
  expectMatchesOracle(shells, 300);
}

TEST(SignedDistance, MatchesBruteForceFarFromTheOrigin) {
  expectMatchesOracle(test::moved(test::lumpyBall(6, 3),
                                  [](const Vec3d& v) {
                                    return v + Vec3d{1e4, -1e4, 1e4};
                                  }),
                      200);
}

TEST(SignedDistance, KeepsItsDigitsOnSlivers) {
  // A column squashed to a millionth: every side triangle is a needle with angles near 1e-6.
  expectMatchesOracle(test::moved(test::lumpyBall(8, 5),
                                  [](const Vec3d& v) {
                                    return Vec3d{v.x, v.y, v.z * 1e-6};
                                  }),
                      300);
}

TEST(SignedDistance, IsExactWhereNearestFeaturesTie) {
  // In the middle planes of a cube two to six faces, and four edges or more, are equally near.
  const TriangleMesh cube = test::meshOf(test::cuboid({2, 2, 2}, 3));
  const SignedDistance solid(cube);
  for (const double x : {0.0, 0.25, -0.5, 1.0, -1.0, 2.0, -3.0}) {
    for (const double y : {0.0, 0.25, -0.5, 1.0, 2.0}) {
      for (const double z : {0.0, -0.25, 1.0, 4.0}) {
        const Vec3d q{x, y, z};
        const Vec3d outside{std::max(std::abs(x) - 1, 0.0), std::max(std::abs(y) - 1, 0.0),
                            std::max(std::abs(z) - 1, 0.0)};
        const double inside = 1 - std::max({std::abs(x), std::abs(y), std::abs(z)});
        EXPECT_NEAR(solid.depth(q), length(outside) > 0 ? -length(outside) : inside, solid.roundingBound(q));
      }
    }
  }
}

TEST(SignedDistance, KnowsInsideAroundAPinchedVertex) {
  // Two tetrahedra that share one vertex: its surroundings are two cones.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
  ASSERT_GT(signedVolume(mesh), 0);
  expectMatchesOracle(mesh, 500);
}

TEST(SignedDistance, ParallelBatchEqualsSingleQueries) {
  const TriangleMesh mesh = test::lumpyBall(10, 9);
  const SignedDistance solid(mesh);
  const std::vector<Vec3d> queries = queriesFor(mesh, 2000);
  std::vector<double> depths(queries.size());
  solid.depths(queries, depths);
  for (std::size_t i = 0; i < queries.size(); ++i) ASSERT_EQ(depths[i], solid.depth(queries[i]));
}

TEST(SignedDistance, IsOneLipschitz) {
  const TriangleMesh mesh = test::torus(1, 0.4, 16, 8);
  const SignedDistance solid(mesh);
  std::mt19937_64 engine(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const Vec3d p = test::randomPoint(engine) * 2.0, q = test::randomPoint(engine) * 2.0;
    ASSERT_LE(std::abs(solid.depth(p) - solid.depth(q)), distance(p, q) + 2 * solid.roundingBound({2, 2, 2}));
  }
}

TEST(SignedDistance, DistanceToOneTriangleIsConvexAndNeverBelowTheNearest) {
  const TriangleMesh mesh = test::lumpyBall(5, 2);
  const SignedDistance solid(mesh);
  std::mt19937_64 engine(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const auto t = static_cast<std::uint32_t>(engine() % mesh.triangles.size());
    const Vec3d p = test::randomPoint(engine) * 1.5, q = test::randomPoint(engine) * 1.5;
    const double bound = 2 * solid.roundingBound({1.5, 1.5, 1.5});
    const double atP = solid.distanceToTriangle(t, p), atQ = solid.distanceToTriangle(t, q);
    ASSERT_GE(atP, solid.closest(p).distance - bound);
    ASSERT_LE(solid.distanceToTriangle(t, (p + q) * 0.5), (atP + atQ) / 2 + bound);
  }
}

// Rounding of a sum over n triangles of terms of the order of the result.
double sumTolerance(const TriangleMesh& mesh) {
  return 1e-15 * static_cast<double>(mesh.triangles.size() + 10);
}

TEST(MassProperties, OfACuboidAreThoseOfTheFormula) {
  const Vec3d size{1, 2, 3};
  for (const int cells : {1, 4}) {
    const TriangleMesh mesh = test::moved(test::meshOf(test::cuboid(size, cells)), [](const Vec3d& v) {
      return v + Vec3d{5, -6, 7};
    });
    const MassProperties mass = massPropertiesOf(mesh);
    const double tolerance = 20 * sumTolerance(mesh);
    EXPECT_NEAR(mass.volume, 6, 6 * tolerance);
    EXPECT_NEAR(distance(mass.centerOfMass, {5, -6, 7}), 0, 10 * tolerance);
    const Vec3d moments{(4 + 9) / 12.0, (1 + 9) / 12.0, (1 + 4) / 12.0};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(mass.inertia(i, j), i == j ? moments[i] : 0, tolerance);
    }
    EXPECT_NEAR(mass.principalMoments[0], moments[2], tolerance);
    EXPECT_NEAR(mass.principalMoments[1], moments[1], tolerance);
    EXPECT_NEAR(mass.principalMoments[2], moments[0], tolerance);
  }
}

TEST(MassProperties, PrincipalAxesDiagonalizeAndAreRightHanded) {
  std::mt19937_64 engine(kSeed);
  for (int i = 0; i < 50; ++i) {
    const Mat3d turn = test::randomRotation(engine);
    const TriangleMesh mesh = test::moved(test::lumpyBall(4, engine()), [&](const Vec3d& v) {
      return turn * Vec3d{v.x, 2 * v.y, 3 * v.z};
    });
    const MassProperties mass = massPropertiesOf(mesh);
    const Mat3d diagonal = transpose(mass.principalAxes) * mass.inertia * mass.principalAxes;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(diagonal(r, c), r == c ? mass.principalMoments[r] : 0, 1e-11) << "seed " << kSeed;
    }
    const Mat3d& axes = mass.principalAxes;
    EXPECT_NEAR(dot(axes.column(0), cross(axes.column(1), axes.column(2))), 1, 1e-12);
    EXPECT_LE(mass.principalMoments[0], mass.principalMoments[1]);
    EXPECT_LE(mass.principalMoments[1], mass.principalMoments[2]);
  }
}

TEST(MassProperties, OfACubeHaveTheMeshesAxes) {
  const MassProperties mass = massPropertiesOf(test::meshOf(test::cuboid({1, 1, 1}, 3)));
  for (int c = 0; c < 3; ++c) {
    const Vec3d axis = mass.principalAxes.column(c);
    EXPECT_EQ(std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z), 1);
  }
}

TEST(MassProperties, OfACavityAreSubtracted) {
  const TriangleMesh outer = test::meshOf(test::cuboid({2, 2, 2}, 2));
  const TriangleMesh hollow = test::joined(outer, test::flipped(test::meshOf(test::cuboid({1, 1, 1}, 2))));
  EXPECT_NEAR(massPropertiesOf(hollow).volume, 7, 1e-12);
  EXPECT_NEAR(massPropertiesOf(hollow).inertia(0, 0), (8 * 8 / 12.0 - 1 * 2 / 12.0) / 7, 1e-12);
  EXPECT_LT(signedVolume(test::flipped(outer)), 0);
}

}  // namespace
}  // namespace cairn::builder::surface_test
