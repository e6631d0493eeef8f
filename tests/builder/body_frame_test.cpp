// SPDX-License-Identifier: GPL-3.0-or-later
// Results computed in a body's own frame do not depend on the mesh's: adaptive levels.
#include "hierarchy/body_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "placed_mesh.h"

namespace cairn::builder::body_frame_test {
namespace {

struct Body {
  const char* name;
  TriangleMesh mesh;
};

std::vector<Body> bodies() {
  return {{"lumpy ball", test::lumpyBall(3, 5)},
          {"cube, all corners equally far", test::meshOf(test::cuboid({1, 1, 1}, 3))},
          {"ball, all vertices equally far", test::meshOf(test::ball(1, 2))},
          {"cylinder, the farthest vertices on circles", test::cylinder(0.5, 2, 24)},
          {"torus", test::torus(1, 0.4, 24, 12)}};
}

TEST(BodyFrame, TakesThereAndBack) {
  const TriangleMesh mesh = test::placedMesh(test::lumpyBall(2, 1), 7);
  const BodyFrame frame(mesh);
  for (const Vec3d& v : mesh.vertices) {
    const Vec3d inside = frame.into(v);
    EXPECT_LE(length(inside), 1 + 1e-12);
    // A few roundings of lengths up to 30.
    EXPECT_LE(distance(frame.outOf(inside), v), 30 * 0x1p-48);
  }
}

TEST(BodyFrame, MeshIsTheSameBitsHoweverItLies) {
  for (const Body& body : bodies()) {
    SCOPED_TRACE(body.name);
    const TriangleMesh as = bodyMesh(body.mesh, BodyFrame(body.mesh));
    for (const double scale : {1.0, 1e-6, 1e6}) {
      const TriangleMesh mesh = test::placedMesh(body.mesh, scale);
      const TriangleMesh same = bodyMesh(mesh, BodyFrame(mesh));
      EXPECT_EQ(same.vertices, as.vertices) << "at scale " << scale;
    }
  }
}

TEST(BodyFrame, RoundsVerticesByLessThanItSays_AndNarrowTrianglesNotAtAll) {
  TriangleMesh mesh = test::lumpyBall(2, 3);
  const auto farthestMove = [&] {
    const BodyFrame frame(mesh);
    const TriangleMesh body = bodyMesh(mesh, frame);
    double most = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      most = std::max(most, distance(body.vertices[v], frame.into(mesh.vertices[v])));
    return most;
  };
  EXPECT_GT(farthestMove(), 0);
  EXPECT_LE(farthestMove(), kBodyRounding);
  const Triangle t = mesh.triangles[0];
  mesh.vertices[t[0]] = (mesh.vertices[t[1]] + mesh.vertices[t[2]]) * (0.5 + 1e-9);
  EXPECT_EQ(farthestMove(), 0);
}

/// A cone on either side of a disc: its triangles are wide, however thin it is.
TriangleMesh lens(double thickness) {
  constexpr std::uint32_t kSides = 32;
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, thickness / 2}, {0, 0, -thickness / 2}};
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 0});
  }
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t here = 2 + i, next = 2 + (i + 1) % kSides;
    mesh.triangles.push_back({0, here, next});
    mesh.triangles.push_back({1, next, here});
  }
  mesh.name = "lens";
  return mesh;
}

// Thinner than the grid its corners would be rounded to, a solid would be flat: its tree fits like that of a thicker
// one.
TEST(BodyFrame, SolidsThinnerThanItsGridAreNotRounded) {
  // The solids' own thickness, and what the search does with other digits.
  constexpr double kLikeness = 0.25;
  const auto worst = [](double thickness) {
    BuildOptions options;
    options.depth = 2;
    const auto tree = buildTree(lens(thickness), options);
    EXPECT_TRUE(tree) << tree.error().message;
    return tree ? std::array{double(tree.value().levelError(1)), double(tree.value().levelError(2))}
                : std::array{0.0, 0.0};
  };
  const auto usual = worst(1e-4);
  for (const double thickness : {1e-6, 3e-7, 1e-7, 1e-9}) {
    const auto thin = worst(thickness);
    for (std::size_t level = 0; level < 2; ++level)
      EXPECT_NEAR(thin[level] / usual[level], 1, kLikeness) << thickness << ", level " << level + 1;
  }
}

TEST(BodyFrame, AdaptiveLevelsAreTheSameHoweverTheMeshLies) {
  const TriangleMesh mesh = test::lumpyBall(1, 5);
  const auto as = buildTree(mesh, test::quickAdaptive());
  ASSERT_TRUE(as);
  for (const double scale : {1e-6, 1e6}) {
    SCOPED_TRACE(scale);
    test::expectSameLevels(mesh, as.value(), test::placedMesh(mesh, scale), scale);
  }
}

/// The change of the level's error when every coordinate moves by up to 1e-5.
constexpr double kJitterEffect = 0.05;

TEST(BodyFrame, JitterHardlyChangesTheFirstAdaptiveLevel) {
  BuildOptions options;
  options.method = Method::adaptive;
  options.depth = 1;
  const TriangleMesh mesh = test::lumpyBall(1, 5);
  const auto as = buildTree(mesh, options);
  ASSERT_TRUE(as);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto jitter = [&] { return test::uniform(random, -1e-5, 1e-5); };
    const auto jittered = buildTree(test::moved(mesh,
                                                [&](Vec3d p) {
                                                  for (int axis = 0; axis < 3; ++axis) p[axis] += jitter();
                                                  return p;
                                                }),
                                    options);
    ASSERT_TRUE(jittered);
    EXPECT_NEAR(jittered.value().levelError(1), as.value().levelError(1), kJitterEffect * as.value().levelError(1));
  }
}

}  // namespace
}  // namespace cairn::builder::body_frame_test
