// SPDX-License-Identifier: Zlib
#include "cairn/core/sphere_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "random_tree.h"

namespace cairn::sphere_tree_test {
namespace {

SphereTree treeOf(const SphereTreeData& data) {
  Result<SphereTree> tree = SphereTree::create(data);
  EXPECT_TRUE(tree.ok()) << tree.error().message;
  return std::move(tree).value();
}

TEST(SphereTree, Nodes_KeepTheirRecordsAndLinks) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SphereTreeData data = test::randomTree(seed).data;
    const SphereTree tree = treeOf(data);
    ASSERT_EQ(tree.nodeCount(), data.nodes.size());
    std::uint32_t leaves = 0;
    for (std::uint32_t record = 0; record < tree.nodeCount(); ++record) {
      const NodeId id = tree.nodeAt(record);
      ASSERT_EQ(tree.node(id), data.nodes[record]) << "seed " << seed;
      ASSERT_EQ(tree.sphere(id), (Sphere{data.nodes[record].center, data.nodes[record].radius}));
      leaves += tree.isLeaf(id);
      if (record > 0) ASSERT_EQ(tree.childFamily(tree.nodeAt(data.nodes[record].parent)), id / kFamilyWidth);
    }
    EXPECT_EQ(leaves, tree.leafCount());
  }
}

TEST(SphereTree, TwoSpheresANode_OneBoundsAndTheOtherAnswers) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    test::RandomTree random = test::randomTree(seed);
    const SphereTree one = treeOf(random.data);
    test::addBounds(random, seed);
    const SphereTree two = treeOf(random.data);
    EXPECT_EQ(one.spheresPerNode(), 1U);
    EXPECT_EQ(two.spheresPerNode(), 2U);
    EXPECT_GT(two.memoryBytes(), one.memoryBytes());
    for (std::uint32_t record = 0; record < two.nodeCount(); ++record) {
      const NodeId id = two.nodeAt(record);
      EXPECT_EQ(one.bound(id), one.sphere(id));
      EXPECT_EQ(two.sphere(id), one.sphere(id)) << "seed " << seed;
      EXPECT_EQ(two.bound(id), random.data.bounds[record]);
      EXPECT_EQ(two.family(id / kFamilyWidth).sphere(id % kFamilyWidth), random.data.bounds[record]);
      EXPECT_EQ(two.error(id), one.error(id));
      EXPECT_EQ(two.childFamily(id), one.childFamily(id));
      for (const Sphere& ball : {two.sphere(id), two.bound(id)})
        EXPECT_GE(two.extent(), length(ball.center) + ball.radius);
    }
  }
}

TEST(SphereTree, LevelCut_IsAnAntichainThatEveryLeafPathCrossesOnce) {
  const SphereTree tree = treeOf(test::randomTree(5).data);
  for (std::uint32_t level = 0; level <= tree.depth(); ++level) {
    std::vector<int> crossings(tree.nodeCount(), 0);
    std::vector<bool> inCut(tree.families().size() * kFamilyWidth, false);
    for (const NodeId id : tree.levelCut(level)) inCut[id] = true;
    for (std::uint32_t record = 0; record < tree.nodeCount(); ++record) {
      const NodeId id = tree.nodeAt(record);
      crossings[record] = (record > 0 ? crossings[tree.node(id).parent] : 0) + inCut[id];
      if (tree.isLeaf(id)) EXPECT_EQ(crossings[record], 1) << "level " << level << ", record " << record;
    }
  }
}

TEST(SphereTree, LoneRoot_IsALeafOfDepthZero) {
  const SphereTree tree = treeOf(test::randomTree(3, 4, 0).data);
  EXPECT_EQ(tree.depth(), 0U);
  EXPECT_EQ(tree.leafCount(), 1U);
  EXPECT_TRUE(tree.isLeaf(kRootNode));
  EXPECT_EQ(tree.levelCut(0).size(), 1U);
}

struct Damage {
  const char* message;  // what the sentence has to contain
  std::function<void(SphereTreeData&)> apply;
};

class SphereTreeDamage : public testing::TestWithParam<Damage> {};

TEST_P(SphereTreeDamage, Create_RefusesAndNamesIt) {
  SphereTreeData data = test::randomTree(7).data;
  GetParam().apply(data);
  const Result<SphereTree> tree = SphereTree::create(std::move(data));
  ASSERT_FALSE(tree.ok());
  EXPECT_NE(tree.error().message.find(GetParam().message), std::string::npos) << tree.error().message;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

std::vector<Sphere>& boundsOf(SphereTreeData& data) {
  for (const NodeData& n : data.nodes) data.bounds.push_back({n.center, n.radius});
  return data.bounds;
}

INSTANTIATE_TEST_SUITE_P(
    Elements, SphereTreeDamage,
    testing::Values(
        Damage{"it has no nodes", [](auto& d) { d.nodes.clear(); }},
        Damage{"node 3 has a number that is not finite", [](auto& d) { d.nodes[3].center.y = kNan; }},
        Damage{"node 3 has a number that is not finite", [](auto& d) { d.nodes[3].radius = kInf; }},
        Damage{"node 3 has no positive radius", [](auto& d) { d.nodes[3].radius = 0; }},
        Damage{"node 3 lies outside the range of lengths", [](auto& d) { d.nodes[3].center.z = -1e30F; }},
        Damage{"node 3 lies outside the range of lengths", [](auto& d) { d.nodes[3].radius = 1e16F; }},
        Damage{"node 3 has a negative error", [](auto& d) { d.nodes[3].error = -1; }},
        Damage{"node 3 has an inner radius", [](auto& d) { d.nodes[3].innerRadius = d.nodes[3].radius * 2; }},
        Damage{"the root has a parent", [](auto& d) { d.nodes[0].parent = 1; }},
        Damage{"node 4 is not in breadth-first order", [](auto& d) { d.nodes[4].parent = 4; }},
        Damage{"is not in breadth-first order", [](auto& d) { std::swap(d.nodes[1].parent, d.nodes.back().parent); }},
        Damage{"more than eight children",
               [](auto& d) {
                 for (auto& n : d.nodes) n.parent = 0;
               }},
        Damage{"node 2 has a wrong range of support points", [](auto& d) { d.nodes[2].supportCount = 0; }},
        Damage{"node 2 has a wrong range of support points", [](auto& d) { d.nodes[2].firstSupport = 0xFFFFFFFF; }},
        Damage{"node 2 has a wrong range of face normals", [](auto& d) { d.nodes[2].normalCount = 1; }},
        Damage{"node 2 has a wrong range of triangles", [](auto& d) { d.nodes[2].triangleCount = 5; }},
        Damage{"node 1 has triangles outside its parent's", [](auto& d) { d.nodes[0].triangleCount = 3; }},
        Damage{"node 2 has a normal cone", [](auto& d) { d.nodes[2].normalCone.cosine = 2; }},
        Damage{"vertex 1 is not finite", [](auto& d) { d.vertices[1].x = kInf; }},
        Damage{"triangle 2 names a vertex", [](auto& d) { d.triangles[2][1] = 4; }},
        Damage{"region triangle 1 does not exist", [](auto& d) { d.regionTriangles[1] = 4; }},
        Damage{"it has no mesh", [](auto& d) { d.triangles.clear(); }},
        Damage{"of level mesh 1: it has no mesh",
               [](auto& d) {
                 d.levelMeshes = {{{}, d.triangles, 0}};
               }},
        Damage{"of level mesh 2: vertex 0 is not finite",
               [](auto& d) {
                 d.levelMeshes = {{d.vertices, d.triangles, 0}, {{{kNan, 0, 0}}, d.triangles, 0}};
               }},
        Damage{"of level mesh 1: triangle 2 names a vertex",
               [](auto& d) {
                 d.levelMeshes = {{d.vertices, d.triangles, 0}};
                 d.levelMeshes[0].triangles[2][1] = 4;
               }},
        Damage{"of level mesh 1: its distance is not a length",
               [](auto& d) {
                 d.levelMeshes = {{d.vertices, d.triangles, -1}};
               }},
        Damage{"of level mesh 1: its distance is not a length",
               [](auto& d) {
                 d.levelMeshes = {{d.vertices, d.triangles, kNan}};
               }},
        Damage{"level mesh 1 reaches far outside the root's ball",
               [](auto& d) {
                 d.levelMeshes = {{d.vertices, d.triangles, 0}};
                 d.levelMeshes[0].vertices[1].x = 1e20F;
               }},
        Damage{"it has more level meshes than",
               [](auto& d) {
                 d.levelMeshes.assign(kMaxDepth + 1, {d.vertices, d.triangles, 0});
               }},
        Damage{"it has 2 bounds for",
               [](auto& d) {
                 d.bounds = {{{}, 1}, {{}, 1}};
               }},
        Damage{"the bound of node 3 has a number that is not finite", [](auto& d) { boundsOf(d)[3].radius = kNan; }},
        Damage{"the bound of node 3 has a number that is not finite", [](auto& d) { boundsOf(d)[3].center.x = kInf; }},
        Damage{"the bound of node 3 has no positive radius", [](auto& d) { boundsOf(d)[3].radius = 0; }},
        Damage{"the bound of node 3 lies outside the range of lengths", [](auto& d) { boundsOf(d)[3].radius = 1e16F; }},
        Damage{"the bound of node 3 lies outside the range of lengths",
               [](auto& d) { boundsOf(d)[3].center.z = -1e30F; }},
        Damage{"support point 0 is not finite", [](auto& d) { d.supportPoints[0].z = kNan; }},
        Damage{"support point 2 lies far outside the root's ball", [](auto& d) { d.supportPoints[2].y = 1e20F; }},
        Damage{"support point 2 lies far outside the root's ball", [](auto& d) { d.supportPoints[2].y = 3e38F; }},
        Damage{"vertex 1 lies far outside the root's ball", [](auto& d) { d.vertices[1].x = 100; }},
        Damage{"its centre of mass lies far outside", [](auto& d) { d.mass.centerOfMass.z = 1e9; }},
        Damage{"its volume is far more than", [](auto& d) { d.mass.volume = 1e9; }},
        Damage{"has its moments of inertia", [](auto& d) { d.mass.principalMoments.y = 1e9; }},
        Damage{"has its moments of inertia", [](auto& d) { d.mass.principalMoments.y = 1e-30; }},
        Damage{"has its moments of inertia", [](auto& d) { d.mass.inertia(1, 1) = 1e-30; }},
        Damage{"has its moments of inertia", [](auto& d) { d.mass.inertia(0, 1) = 1e9; }},
        Damage{"face normal 0 is not a unit vector", [](auto& d) { d.faceNormals = {{1, 1, 0}}; }},
        Damage{"its volume is not positive", [](auto& d) { d.mass.volume = -1; }},
        Damage{"its moments of inertia are not positive", [](auto& d) { d.mass.principalMoments.y = 0; }},
        Damage{"its principal axes are not a rotation", [](auto& d) { d.mass.principalAxes(0, 0) = -1; }},
        Damage{"its origin is not finite", [](auto& d) { d.origin.x = std::nan(""); }}));

TEST(SphereTree, Depth_IsBounded) {
  SphereTreeData data = test::randomTree(7, 4, 0).data;
  for (std::uint32_t i = 0; i <= kMaxDepth; ++i) {
    data.nodes.push_back(data.nodes[0]);
    data.nodes.back().parent = i;
  }
  const Result<SphereTree> tree = SphereTree::create(std::move(data));
  ASSERT_FALSE(tree.ok());
  EXPECT_NE(tree.error().message.find("deeper than 15 levels"), std::string::npos);
}

}  // namespace
}  // namespace cairn::sphere_tree_test
