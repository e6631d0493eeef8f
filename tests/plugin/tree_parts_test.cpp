// SPDX-License-Identifier: Zlib
// Trees as they are swept: nodes, and triangles below leaves.
#include "continuous/tree_parts.h"

#include <gtest/gtest.h>

#include "bullet_world.h"
#include "placement/tree_pose.h"
#include "test_solids.h"

namespace cairn::test::tree_parts_test {
namespace {

using bullet::TreeParts;

// A course is that of each part's middle: it has to be a point of the body, or the triangle is not where it is said.
TEST(TreeParts, OfATriangleTurnWithTheTree) {
  constexpr double kRounding = 1e-6;
  const auto tree = plainTree(cuboid({1, 0.6, 0.3}, 1), 12);
  const auto shape = treeShape(tree);
  const btTransform turned(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.2)), btVector3(1, 0, 0));
  const auto partsAt = [&](const btTransform& body) {
    return TreeParts(bullet::PlacedTree(*tree, bullet::treePose(*shape, body)));
  };
  const TreeParts still = partsAt(btTransform::getIdentity()), moved = partsAt(turned);
  std::uint32_t triangles = 0;
  for (const NodeId leaf : tree->levelCut(tree->depth())) {
    const TreeParts::Children below = still.children(leaf, 0);
    for (std::uint32_t i = 0; i < below.count; ++i, ++triangles) {
      const Sphere from = still.sphere(below.first + i), to = moved.sphere(below.first + i);
      const btVector3 expected = turned * btVector3(from.center.x, from.center.y, from.center.z);
      EXPECT_LT((expected - btVector3(to.center.x, to.center.y, to.center.z)).length(), kRounding);
      EXPECT_NEAR(from.radius, to.radius, kRounding);
      const bullet::Triangle corners = still.triangle(below.first + i);
      for (const Vec3& corner : {corners.a, corners.b, corners.c})
        EXPECT_LT(double(distance(corner, from.center)), double(from.radius) + kRounding);
    }
  }
  EXPECT_EQ(triangles, 12U);
}

}  // namespace
}  // namespace cairn::test::tree_parts_test
