// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "cairn/builder/certify.h"
#include "spheres/solid_octants.h"

namespace cairn::builder::solid_octree_test {
namespace {

TEST(SolidOctants, Parts_HoldAllSurfaceTheyMeetAndInsideOnesNone) {
  for (const TriangleMesh& mesh : {test::torus(1, 0.4, 24, 12), test::meshOf(test::cuboid({1, 1, 1}, 3))}) {
    const SignedDistance solid(mesh);
    const Cube cube = cubeAround(boundsOf(mesh));
    constexpr double kFinest = 0.02;
    const Pieces pieces = piecesOf(mesh);
    const SolidOctants whole = divideSolid(pieces, cube, kFinest, solid);
    SolidOctants parts;
    for (const Octant& octant : whole.surface) {
      const SolidOctants quarter = divideSolid(octant.pieces, octant.cube, kFinest, solid);
      parts.surface.insert(parts.surface.end(), quarter.surface.begin(), quarter.surface.end());
      parts.inside.insert(parts.inside.end(), quarter.inside.begin(), quarter.inside.end());
    }
    EXPECT_FALSE(parts.surface.empty());
    std::mt19937_64 engine(51);
    for (const Cube& inside : parts.inside)
      for (int i = 0; i < 100; ++i)
        EXPECT_GE(solid.depth(inside.center + test::randomPoint(engine) * inside.halfEdge), -1e-12) << "seed 51";
    // Every point of the solid lies in a part.
    for (int trial = 0; trial < 3000; ++trial) {
      const Vec3d p = test::randomPoint(engine) * 1.4;
      if (solid.depth(p) < 0) continue;
      const auto holds = [&](const Cube& c) {
        const Vec3d d = p - c.center;
        return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= c.halfEdge;
      };
      EXPECT_TRUE(std::ranges::any_of(parts.surface, [&](const Octant& o) { return holds(o.cube); }) ||
                  std::ranges::any_of(parts.inside, holds))
          << "seed 51, trial " << trial;
    }
    for (const Octant& octant : parts.surface)
      for (const Piece& piece : octant.pieces)
        for (const Vec3d& corner : piece.corners)
          EXPECT_LE(distance(corner, octant.cube.center), octant.cube.circumradius() + kFinest);
  }
}

BuildOptions solidBuild() {
  BuildOptions options;
  options.method = Method::solidOctree;
  options.depth = 4;
  options.samples = 1000;
  return options;
}

TEST(SolidOctree, PointsInside_AreInALeafAndItsAncestors) {
  for (const TriangleMesh& mesh : {test::meshOf(test::cuboid({1, 0.7, 0.6}, 1)), test::lumpyBall(2, 3)}) {
    const Result<SphereTree> tree = buildTree(mesh, solidBuild());
    ASSERT_TRUE(tree);
    const SignedDistance solid(mesh);
    const auto& nodes = tree.value().data().nodes;
    std::vector<bool> isLeaf(nodes.size(), true);
    for (std::size_t i = 1; i < nodes.size(); ++i) isLeaf[nodes[i].parent] = false;
    const auto holds = [&](std::size_t node, const Vec3d& p) {
      return distance(p, Vec3d(nodes[node].center)) <= static_cast<double>(nodes[node].radius);
    };
    const auto reaches = [&](std::size_t leaf, const Vec3d& p) {
      std::size_t i = leaf;
      while (holds(i, p) && i != 0) i = nodes[i].parent;
      return i == 0 && holds(0, p);
    };
    std::mt19937_64 engine(52);
    int tested = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      const Vec3d p = test::randomPoint(engine);
      if (solid.depth(p) < 1e-6) continue;  // what the float tree rounds by
      ++tested;
      bool found = false;
      for (std::size_t i = 0; i < nodes.size() && !found; ++i)
        found = isLeaf[i] && reaches(i, p - tree.value().origin());
      EXPECT_TRUE(found) << "seed 52, trial " << trial;
    }
    EXPECT_GT(tested, 50);
  }
}

TEST(SolidOctree, Tree_HasLeavesWhollyInsideAndIsCertified) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 0.9, 0.8}, 1));
  const Result<SphereTree> tree = buildTree(mesh, solidBuild());
  ASSERT_TRUE(tree);
  const Result<Certificate> certificate = certify(tree.value(), mesh);
  ASSERT_TRUE(certificate);
  EXPECT_EQ(certificate.value().failures(tree.value()), std::vector<std::string>{});
  const auto& nodes = tree.value().data().nodes;
  EXPECT_TRUE(std::ranges::any_of(nodes, [](const NodeData& n) { return n.innerRadius > 0 && n.error == 0; }));
}

}  // namespace
}  // namespace cairn::builder::solid_octree_test
