// SPDX-License-Identifier: Zlib
// Going down a tree towards a point of its surface ends at a leaf beside that point.
#include <gtest/gtest.h>

#include <random>

#include "placement/placed_tree.h"
#include "random_tree.h"
#include "test_trees.h"

namespace cairn::test::leaf_at_test {
namespace {

constexpr unsigned kSeed = 71;

// From the point to the ball, negative inside; pair frame.
float outside(const bullet::PlacedTree& tree, NodeId node, const Vec3& point) {
  const Sphere ball = tree.sphere(node);
  return distance(ball.center, point) - ball.radius;
}

TEST(PlacedTree, FindsALeafAtEachPointOfItsSurface) {
  std::mt19937_64 engine(kSeed);
  for (const auto& solid : {cuboid({1, 0.7, 0.4}, 8), ball(0.5, 12), torus(0.3, 0.12, 16)}) {
    const auto tree = plainTree(solid, 4);
    const bullet::PlacedTree placed(*tree, Pose{randomRotation(engine), randomPoint(engine), 1.7});
    for (const Vec3& vertex : tree->vertices()) {
      const Vec3 point = placed.toPair() * vertex;
      const NodeId leaf = placed.leafAt(point);
      ASSERT_TRUE(tree->isLeaf(leaf)) << "seed " << kSeed;
      // Some leaf holds the point; the one found may be its neighbour.
      EXPECT_LE(outside(placed, leaf, point), placed.sphere(leaf).radius) << "seed " << kSeed;
    }
  }
}

}  // namespace
}  // namespace cairn::test::leaf_at_test
