// SPDX-License-Identifier: Zlib
// How a tree's source mesh hangs together: adjacency, thickness, inside and outside, patches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "cairn/core/surface_ray.h"
#include "random_tree.h"
#include "test_trees.h"

namespace cairn::test::surface_test {
namespace {

constexpr unsigned kSeed = 11;

TEST(SurfaceFeatures, OfACubeAreItsEdgesAndDiagonals) {
  const auto tree = plainTree(cuboid({1, 1, 1}, 1), 2);
  const SurfaceFeatures& features = tree->surface().features;
  ASSERT_EQ(features.edges().size(), 18U);
  EXPECT_EQ(std::ranges::count(features.edges(), true, &SurfaceEdge::isConvex), 12);
  for (const SurfaceEdge& edge : features.edges()) {
    if (!edge.isConvex) continue;
    EXPECT_NEAR(length(edge.outward), 1, 1e-6);
    const Vec3 middle = (tree->vertices()[edge.vertex[0]] + tree->vertices()[edge.vertex[1]]) * 0.5F;
    EXPECT_NEAR(dot(edge.outward, normalized(middle)), 1, 1e-6) << "a cube's edges face away from its middle";
  }
}

TEST(SurfaceFeatures, OfADentAreNotConvex) {
  const auto tree = plainTree(bowl(0.7, 0.5, 24), 4);
  int inner = 0, outer = 0;
  for (const SurfaceEdge& edge : tree->surface().features.edges()) {
    const Vec3d a = Vec3d(tree->vertices()[edge.vertex[0]]) + tree->origin();
    const Vec3d b = Vec3d(tree->vertices()[edge.vertex[1]]) + tree->origin();
    const bool isInner = length(a) < 0.51 && length(b) < 0.51 && a.z < -0.05 && b.z < -0.05;
    const bool isOuter = length(a) > 0.69 && length(b) > 0.69 && a.z < -0.05 && b.z < -0.05;
    if (isInner) EXPECT_FALSE(edge.isConvex);
    inner += isInner;
    outer += isOuter && edge.isConvex;
  }
  EXPECT_GT(inner, 50);
  EXPECT_GT(outer, 50);
}

TEST(SurfaceFeatures, HaveHollowsWhereTheyBendInwardsOrEnd) {
  const auto hasHollows = [](const Solid& solid) { return plainTree(solid)->surface().features.hasHollows(); };
  EXPECT_FALSE(hasHollows(cuboid({1, 1, 1}, 3)));
  EXPECT_FALSE(hasHollows(ball(0.4, 8)));
  EXPECT_TRUE(hasHollows(torus(0.35, 0.12, 16)));
  EXPECT_TRUE(hasHollows(bowl(0.7, 0.5, 24)));
  Solid open = cuboid({1, 1, 1}, 1);
  open.triangles.pop_back();
  EXPECT_TRUE(
      SurfaceFeatures(std::vector<Vec3>(open.vertices.begin(), open.vertices.end()), open.triangles).hasHollows());
}

// Every triangle's edges and every vertex's, both ways; of a mesh with a border too.
TEST(SurfaceFeatures, AgreeWithTheTriangles) {
  const Solid solid = torus(0.3, 0.12, 10);
  std::vector<Vec3> vertices;
  for (const Vec3d& v : solid.vertices) vertices.emplace_back(v);
  std::vector<std::array<std::uint32_t, 3>> triangles = solid.triangles;
  triangles.resize(triangles.size() / 2);
  const SurfaceFeatures features(vertices, triangles);
  std::size_t borders = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const SurfaceEdge& edge = features.edges()[features.edgesOf()[t][k]];
      const std::uint32_t v = triangles[t][k], w = triangles[t][(k + 1) % 3];
      EXPECT_EQ(std::set({edge.vertex[0], edge.vertex[1]}), std::set({v, w}));
      ASSERT_TRUE(edge.triangle[0] == t || edge.triangle[1] == t);
      EXPECT_EQ(edge.opposite[edge.triangle[0] == t ? 0 : 1], triangles[t][(k + 2) % 3]);
      borders += edge.triangle[1] == SurfaceEdge::kNone;
      for (const std::uint32_t end : {v, w}) {
        const auto around = features.edgesAround(end);
        EXPECT_NE(std::ranges::find(around, features.edgesOf()[t][k]), around.end());
        EXPECT_EQ(features.across(features.edgesOf()[t][k], end), end == v ? w : v);
      }
    }
  EXPECT_GT(borders, 0U);
}

TEST(SurfaceThickness, IsThatOfSlabsAndTubes) {
  EXPECT_NEAR(plainTree(cuboid({1, 1, 1}, 3), 4)->surface().thickness, 1, 1e-5);
  EXPECT_NEAR(plainTree(cuboid({1, 1, 0.1}, 3), 4)->surface().thickness, 0.1, 1e-5);
  // Between opposite facets of a tube 0.24 across, which is a polygon of 12 sides swept around one of 24.
  const double facets = 0.24 * std::cos(std::numbers::pi / 12) * std::cos(std::numbers::pi / 24);
  const float tube = plainTree(torus(0.3, 0.12, 24), 4)->surface().thickness;
  EXPECT_GT(tube, facets - 1e-5);
  EXPECT_LT(tube, 0.24);
}

TEST(SurfaceRay, KnowsInsideFromOutside) {
  const auto tree = plainTree(torus(0.3, 0.12, 48), 4);
  std::mt19937_64 engine(kSeed);
  SurfaceRay ray;
  int inside = 0, asked = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d p = randomPoint(engine) * 0.45;
    const double fromCircle = std::hypot(std::hypot(p.x, p.y) - 0.3, p.z);
    if (std::abs(fromCircle - 0.12) < 0.002) continue;  // between the circle and its facets
    ++asked;
    inside += fromCircle < 0.12;
    ASSERT_EQ(ray.isInside(tree->surfaceView(), Vec3(p - tree->origin())), fromCircle < 0.12)
        << "seed " << kSeed << ", point " << i;
  }
  EXPECT_GT(inside, asked / 20);
}

// Each triangle in one patch with its vertices, within the patch's box, slab and normals; each edge and vertex one's
// own.
TEST(SurfacePatches, HoldEachTriangleOnce) {
  const auto tree = plainTree(torus(0.3, 0.12, 24), 4);
  const SurfacePatches& patches = tree->surface().patches;
  const SurfaceFeatures& features = tree->surface().features;
  std::vector<int> seen(tree->triangles().size(), 0), edges(features.edges().size(), 0);
  std::vector<int> vertices(tree->vertices().size(), 0);
  for (std::uint32_t index = 0; index < patches.count(); ++index) {
    const SurfacePatch patch = patches.patch(index);
    EXPECT_LE(patch.triangles.size(), SurfacePatch::kMaxTriangles);
    for (const std::uint32_t t : patch.triangles) {
      ++seen[t];
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NE(std::ranges::find(patch.vertices, tree->triangles()[t][k]), patch.vertices.end());
        EXPECT_LE(features.faces()[t].normal[int(k)], patch.normals.upper[int(k)]);
        EXPECT_GE(features.faces()[t].normal[int(k)], patch.normals.lower[int(k)]);
      }
    }
    for (std::size_t i = 0; i < patch.edges.size(); ++i) {
      const SurfaceEdge& edge = features.edges()[patch.edges[i]];
      ++edges[patch.edges[i]];
      EXPECT_EQ(edge.isConvex, i < patch.convexEdges);
      for (std::size_t end = 0; end < 2; ++end) EXPECT_EQ(patch.vertices[patch.edgeEnds[i][end]], edge.vertex[end]);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(edge.outward[axis], patch.normals.upper[axis]);
        EXPECT_GE(edge.outward[axis], patch.normals.lower[axis]);
      }
    }
    for (const std::uint32_t v : patch.vertices.first(patch.ownVertices)) ++vertices[v];
    for (const std::uint32_t v : patch.vertices) {
      const Vec3& p = tree->vertices()[v];
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_TRUE(p[axis] >= patch.box.lower[axis] && p[axis] <= patch.box.upper[axis]);
      EXPECT_LE(dot(patch.facing, p), patch.highest);
      EXPECT_GE(dot(patch.facing, p), patch.lowest);
    }
  }
  EXPECT_EQ(std::ranges::count(seen, 1), std::ptrdiff_t(seen.size()));
  EXPECT_EQ(std::ranges::count(edges, 1), std::ptrdiff_t(edges.size()));
  EXPECT_EQ(std::ranges::count(vertices, 1), std::ptrdiff_t(vertices.size()));
}

// Each patch is reached from the root once, and lies within the boxes on its way.
TEST(SurfacePatches, AreFoundByTheirBoxes) {
  const auto tree = plainTree(ball(0.5, 12), 4);
  const SurfacePatches& patches = tree->surface().patches;
  std::vector<int> reached(patches.count(), 0);
  const auto isWithin = [](const Box& inner, const Box& outer) {
    for (int axis = 0; axis < 3; ++axis)
      if (inner.lower[axis] < outer.lower[axis] || inner.upper[axis] > outer.upper[axis]) return false;
    return true;
  };
  const auto visit = [&](const auto& self, std::uint32_t index, const Box& around) -> void {
    const PatchFamily& family = patches.families()[index];
    for (std::uint32_t lane = 0; lane < PatchFamily::kWidth; ++lane) {
      const Box box = family.box(lane);
      if (box.lower.x > box.upper.x) continue;
      EXPECT_TRUE(isWithin(box, around));
      if (!family.isPatch(lane)) {
        self(self, family.child[lane], box);
        continue;
      }
      ++reached[family.child[lane]];
      EXPECT_TRUE(isWithin(patches.patch(family.child[lane]).box, box));
    }
  };
  visit(visit, 0, patches.box());
  EXPECT_EQ(std::ranges::count(reached, 1), std::ptrdiff_t(reached.size()));
}

}  // namespace
}  // namespace cairn::test::surface_test
