// SPDX-License-Identifier: Zlib
//
// Trees and shapes in C beside the same ones in C++.
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <cmath>

#include "c_world.h"
#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/log.h"

namespace cairn::test {
namespace {

TEST(CTree, IsDescribedAsItIs) {
  const auto tree = plainTree(ball(0.4, 2));
  CairnTreeInfo info;
  cairnDescribeTree(inC(*tree).get(), &info);
  EXPECT_EQ(info.levels, tree->depth());
  EXPECT_EQ(info.nodes, tree->nodeCount());
  EXPECT_EQ(info.leaves, tree->leafCount());
  EXPECT_EQ(info.vertices, tree->vertices().size());
  EXPECT_EQ(info.triangles, tree->triangles().size());
  EXPECT_EQ(info.volume, tree->mass().volume);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(info.inertia[i], tree->mass().inertia(i / 3, i % 3));
}

TEST(CTree, GivesTheSpheresOfALevelInTheMeshsFrame) {
  const auto tree = plainTree(torus(0.35, 0.12, 16));
  const TreeInC handle = inC(*tree);
  for (std::uint32_t level = 0; level <= tree->depth(); ++level) {
    const std::vector<NodeId> cut = tree->levelCut(level);
    ASSERT_EQ(cairnTreeSpheres(handle.get(), level, nullptr, 0), cut.size());
    std::vector<CairnSphere> spheres(cut.size() + 1, CairnSphere{{7, 7, 7}, 7, 7});
    ASSERT_EQ(cairnTreeSpheres(handle.get(), level, spheres.data(), cut.size() - 1), cut.size());
    EXPECT_EQ(spheres[cut.size() - 1].radius, 7) << "more was written than there was room for";
    cairnTreeSpheres(handle.get(), level, spheres.data(), spheres.size());
    EXPECT_EQ(spheres.back().radius, 7);
    for (std::size_t i = 0; i < cut.size(); ++i) {
      EXPECT_EQ(spheres[i].radius, tree->sphere(cut[i]).radius);
      EXPECT_EQ(spheres[i].error, tree->error(cut[i]));
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(spheres[i].center[axis], float(double(tree->sphere(cut[i]).center[axis]) + tree->origin()[axis]));
    }
  }
}

TEST(CTree, GivesItsMesh) {
  const auto tree = plainTree(cuboid({1, 0.3, 0.3}, 3));
  std::vector<float> vertices(3 * tree->vertices().size());
  std::vector<std::uint32_t> triangles(3 * tree->triangles().size());
  const TreeInC handle = inC(*tree);
  cairnTreeMesh(handle.get(), nullptr, nullptr);
  cairnTreeMesh(handle.get(), vertices.data(), triangles.data());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const int axis = static_cast<int>(i % 3);
    EXPECT_EQ(vertices[i], float(double(tree->vertices()[i / 3][axis]) + tree->origin()[axis]));
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) EXPECT_EQ(triangles[i], tree->triangles()[i / 3][i % 3]);
}

TEST(CTree, ThatIsDamagedIsRefusedInASentence) {
  std::vector<std::byte> bytes = encodeTree(*plainTree(ball(0.4, 2)));
  bytes[bytes.size() / 2] ^= std::byte{1};
  EXPECT_EQ(cairnReadTree(bytes.data(), bytes.size()), nullptr);
  EXPECT_NE(std::string(cairnError()).find("checksum"), std::string::npos) << cairnError();
  EXPECT_EQ(cairnReadTree(nullptr, 0), nullptr);
  EXPECT_EQ(cairnLoadTree("nowhere/at all.cairn"), nullptr);
  EXPECT_NE(std::string(cairnError()).find("nowhere/at all.cairn"), std::string::npos) << cairnError();
}

TEST(CShape, OutlivesItsTreeAndIsBullets) {
  const auto tree = plainTree(ball(0.4, 2));
  const CairnShapeOptions twice = {2, 0};
  const ShapeInC usual(cairnMakeShape(inC(*tree).get(), nullptr)), scaled(cairnMakeShape(inC(*tree).get(), &twice));
  EXPECT_FLOAT_EQ(cairnShapeSize(scaled.get()), 2 * cairnShapeSize(usual.get()));
  const auto* shape = static_cast<btCollisionShape*>(cairnBulletShape(usual.get()));
  EXPECT_NE(bullet::asSphereTree(shape), nullptr);
}

TEST(CShape, RefusesScalesAndErrorsThatAreNone) {
  const TreeInC tree = inC(*plainTree(ball(0.4, 2)));
  for (const CairnShapeOptions options :
       {CairnShapeOptions{-1, 0}, CairnShapeOptions{NAN, 0}, CairnShapeOptions{1, -1}, CairnShapeOptions{1, NAN}}) {
    EXPECT_EQ(cairnMakeShape(tree.get(), &options), nullptr);
    EXPECT_GT(std::string(cairnError()).size(), 10U);
  }
}

TEST(CLog, GoesWhereItIsSent) {
  std::vector<std::string> messages;
  cairnSetLog([](const char* message, void* user) { static_cast<std::vector<std::string>*>(user)->push_back(message); },
              &messages);
  const ShapeInC shape(cairnMakeShape(inC(*plainTree(ball(0.4, 2))).get(), nullptr));
  static_cast<btCollisionShape*>(cairnBulletShape(shape.get()))->setLocalScaling(btVector3(1, 2, 3));
  cairnSetLog(nullptr, nullptr);
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_NE(messages[0].find("(1, 2, 3)"), std::string::npos) << messages[0];
  testing::internal::CaptureStderr();
  logMessage("back to standard error");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "cairn: back to standard error\n");
}

}  // namespace
}  // namespace cairn::test
