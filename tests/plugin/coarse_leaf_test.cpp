// SPDX-License-Identifier: Zlib
// How far a body reaches must not depend on how few leaves say so.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "placement/placed_tree.h"
#include "test_trees.h"

namespace cairn::test::coarse_leaf_test {
namespace {

constexpr unsigned kSeed = 31;
constexpr std::uint32_t kTrianglesOfAnEighth = 100;  // more corners than support points
constexpr float kRounding = 1e-6F;                   // of lengths of a metre, and which of two equal corners is named

std::set<std::uint32_t> cornersInTheBall(const SphereTree& tree, NodeId leaf) {
  const Sphere ball = tree.sphere(leaf);
  std::set<std::uint32_t> corners;
  for (const std::uint32_t triangle : tree.regionTriangles(leaf))
    for (const std::uint32_t v : tree.triangles()[triangle])
      if (distance(tree.vertices()[v], ball.center) <= ball.radius) corners.insert(v);
  return corners;
}

// That some corner of the leaf's is no support point.
bool isCoarse(const SphereTree& tree, NodeId node) {
  const auto points = tree.supportPoints(node);
  return tree.isLeaf(node) && std::ranges::any_of(cornersInTheBall(tree, node), [&](std::uint32_t v) {
           return std::ranges::find(points, tree.vertices()[v]) == points.end();
         });
}

/// Leaves of which a builder thought so many support points enough.
std::shared_ptr<const SphereTree> withFewSupportPoints(const Solid& solid, std::uint32_t count) {
  SphereTreeData data = PlainTreeBuilder(solid, kTrianglesOfAnEighth).build();
  for (NodeData& node : data.nodes) node.supportCount = std::min(node.supportCount, count);
  return std::make_shared<const SphereTree>(std::move(SphereTree::create(std::move(data))).value());
}

void expectCornersListedOnce(const SphereTree& tree) {
  int coarse = 0;
  for (std::uint32_t record = 0; record < tree.nodeCount(); ++record) {
    const NodeId node = tree.nodeAt(record);
    const auto corners = tree.regionCorners(node);
    if (!isCoarse(tree, node)) {
      EXPECT_TRUE(corners.empty());
      continue;
    }
    ++coarse;
    const std::set<std::uint32_t> listed(corners.begin(), corners.end());
    EXPECT_EQ(listed.size(), corners.size());
    EXPECT_TRUE(std::ranges::includes(listed, cornersInTheBall(tree, node)));
  }
  EXPECT_GE(coarse, 8);
}

TEST(CoarseLeaf, ListsTheCornersOfItsRegionOnce) {
  expectCornersListedOnce(*plainTree(ball(1, 10), kTrianglesOfAnEighth));
  expectCornersListedOnce(*withFewSupportPoints(ball(1, 10), 5));
}

TEST(CoarseLeaf, ListsNothingWhereCornersAreTooMany) {
  const auto few = plainTree(ball(1, 6), 600), many = plainTree(ball(1, 40), 20000);  // a root alone each
  ASSERT_EQ(few->nodeCount(), 1U);
  ASSERT_EQ(many->nodeCount(), 1U);
  EXPECT_EQ(few->regionCorners(kRootNode).size(), few->vertices().size()) << "all of a root that is a leaf";
  EXPECT_GT(many->vertices().size(), kMaxRegionCorners);
  EXPECT_TRUE(many->regionCorners(kRootNode).empty());
}

void expectReachOfTheMesh(const std::shared_ptr<const SphereTree>& tree) {
  const Pose pose{{}, {0.3, -0.2, 0.1}, 2};
  const bullet::PlacedTree placed(*tree, pose);
  std::mt19937_64 engine(kSeed);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 200; ++i) {
    const Vec3 direction = normalized(Vec3(normal(engine), normal(engine), normal(engine)));
    float mesh = std::numeric_limits<float>::lowest(), leaves = mesh;
    for (const Vec3& v : tree->vertices()) mesh = std::max(mesh, dot(direction, placed.toPair() * v));
    for (std::uint32_t record = 0; record < tree->nodeCount(); ++record)
      if (const NodeId node = tree->nodeAt(record); tree->isLeaf(node))
        leaves = std::max(leaves, dot(direction, placed.extreme(node, direction)));
    EXPECT_NEAR(leaves, mesh, kRounding) << "seed " << kSeed << ", direction " << i;
  }
}

TEST(CoarseLeaf, TogetherReachAsFarAsTheMeshAlongEveryDirection) {
  expectReachOfTheMesh(plainTree(ball(0.5, 10), kTrianglesOfAnEighth));
  expectReachOfTheMesh(withFewSupportPoints(ball(0.5, 10), 5));
}

}  // namespace
}  // namespace cairn::test::coarse_leaf_test
