// SPDX-License-Identifier: Zlib
// Contacts on a tree's coarser meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "bullet_world.h"
#include "test_trees.h"
#include "triangle_grounds.h"

namespace cairn::test::level_mesh_test {
namespace {

using bullet::SphereTreeShape;

constexpr double kRadius = 1;
constexpr int kFine = 24, kMiddle = 10, kCoarse = 4;  // subdivisions of an edge of the octahedron

LevelMesh levelOf(int subdivisions, float distance) {
  const Solid solid = ball(kRadius, subdivisions);
  LevelMesh level;
  for (const Vec3d& v : solid.vertices) level.vertices.emplace_back(v);
  level.triangles.assign(solid.triangles.begin(), solid.triangles.end());
  level.distance = distance;
  return level;
}

// A flat triangle lies below the ball by at most (its longest edge)^2 / 8 over the radius; that edge is at most
// pi / 2 / subdivisions, one and a half times as long in the middle of an octahedron's face.
float boundOf(int subdivisions) {
  const double edge = 1.5 * std::numbers::pi / 2 / subdivisions * kRadius;
  return static_cast<float>(edge * edge / 8 / kRadius);
}

std::shared_ptr<const SphereTree> ballTree() {
  static const std::shared_ptr<const SphereTree> tree = [] {
    SphereTreeData data = plainTree(ball(kRadius, kFine))->data();
    data.levelMeshes = {levelOf(kCoarse, boundOf(kCoarse)), levelOf(kMiddle, boundOf(kMiddle))};
    return std::make_shared<const SphereTree>(SphereTree::create(std::move(data)).value());
  }();
  return tree;
}

std::shared_ptr<SphereTreeShape> shapeFor(double maxContactError) {
  std::shared_ptr<SphereTreeShape> shape = treeShape(ballTree());
  EXPECT_TRUE(shape->setMaxContactError(btScalar(maxContactError)).ok());
  return shape;
}

TEST(LevelMesh, TheCoarsestOneThatIsNearEnoughIsTaken) {
  const btScalar size = treeShape(ballTree())->size();
  const auto levelFor = [&](double error, btScalar smaller) { return shapeFor(error)->contactLevel(smaller); };
  const double middle = double(boundOf(kMiddle)) / double(size), coarse = double(boundOf(kCoarse)) / double(size);
  EXPECT_EQ(levelFor(0, size), 0U);
  EXPECT_EQ(levelFor(0.99 * middle, size), 0U);
  EXPECT_EQ(levelFor(1.01 * middle, size), 2U);
  EXPECT_EQ(levelFor(1.01 * coarse, size), 1U);
  EXPECT_EQ(levelFor(1.01 * coarse, size / 100), 0U) << "the error is a part of the smaller body";
  EXPECT_EQ(levelFor(std::numeric_limits<double>::infinity(), size), 1U);
  EXPECT_EQ(treeShape(ballTree())->contactLevel(size), 0U) << "at first, the source";
}

TEST(LevelMesh, OfAShellIsNotUsedWhereItIsFartherThanTheWallAllows) {
  SphereTreeData data = plainTree(bowl(1, 0.96, 24))->data();
  data.levelMeshes = {levelOf(kMiddle, 0.03F)};
  const std::shared_ptr<SphereTreeShape> shape =
      treeShape(std::make_shared<const SphereTree>(SphereTree::create(std::move(data)).value()));
  ASSERT_TRUE(shape->setMaxContactError(1).ok());
  EXPECT_EQ(shape->contactLevel(shape->size()), 0U);
}

TEST(LevelMesh, WhatIsNoErrorIsRefused) {
  const std::shared_ptr<SphereTreeShape> shape = shapeFor(1);
  for (const double wrong : {-0.1, -std::numeric_limits<double>::infinity(), std::nan("")}) {
    const Status status = shape->setMaxContactError(btScalar(wrong));
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("give 0 for the source mesh"), std::string::npos);
    EXPECT_EQ(shape->maxContactError(), btScalar(1)) << "as before";
  }
}

struct Seen {
  double depth = 0;
  double error = 0;
  int features = 0;  // greatest index of a vertex, an edge or a face
};

void put(BulletWorld<>& world, const std::shared_ptr<SphereTreeShape>& shape, const btQuaternion& turn,
         const btVector3& place) {
  world.add(shape, 1, place).setCenterOfMassTransform(btTransform(turn.normalized(), place));
}

// Two balls along x, so far in each other.
Seen lookAt(const std::shared_ptr<SphereTreeShape>& shape, double overlap, BulletWorld<>& world) {
  world.world.performDiscreteCollisionDetection();
  Seen seen;
  seen.error = world.dispatcher.lastStep().worstErrorFraction * double(shape->size());
  for (int i = 0; i < world.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *world.dispatcher.getManifoldByIndexInternal(i);
    for (int j = 0; j < manifold.getNumContacts(); ++j) {
      seen.depth = std::max(seen.depth, -double(manifold.getContactPoint(j).getDistance()));
      seen.features = std::max(seen.features, manifold.getContactPoint(j).m_index0);
    }
  }
  EXPECT_LE(std::abs(seen.depth - overlap), seen.error + 2 * boundOf(kFine)) << "certified";
  return seen;
}

TEST(LevelMesh, ContactsAreAsFarOffAsTheirErrorSays) {
  constexpr double kOverlap = 0.02;
  for (const auto& [asked, subdivisions] : {std::pair(0.0, kFine), {0.009, kMiddle}, {1.0, kCoarse}}) {
    const std::shared_ptr<SphereTreeShape> shape = shapeFor(asked);
    BulletWorld<> world;
    put(world, shape, btQuaternion(0.1, 0.2, 0.3, 0.9), btVector3(0, 0, 0));
    put(world, shape, btQuaternion(0.4, 0.1, 0.2, 0.8), btVector3(btScalar(2 - kOverlap), 0, 0));
    const Seen seen = lookAt(shape, kOverlap, world);
    const double meshes = subdivisions == kFine ? 0 : 2 * double(boundOf(subdivisions));
    EXPECT_GE(seen.error, meshes * (1 - 1e-5)) << subdivisions << ": both meshes' distances are told";
    EXPECT_LT(seen.features, static_cast<int>(3 * ball(kRadius, subdivisions).triangles.size()) / 2);
  }
}

TEST(LevelMesh, AConvexShapeAndASolidMeshAreToldItsErrorToo) {
  for (const bool isMesh : {false, true}) {
    const std::shared_ptr<SphereTreeShape> shape = shapeFor(1);
    BulletWorld<> world;
    const std::shared_ptr<btCollisionShape> box = std::make_shared<btBoxShape>(btVector3(3, 3, 3));
    world.add(isMesh ? bvhMesh(cuboid({6, 6, 6}, 2)) : box, 0, btVector3(0, 0, -3));
    put(world, shape, btQuaternion(0.1, 0.2, 0.3, 0.9), btVector3(0, 0, btScalar(0.98)));
    world.world.performDiscreteCollisionDetection();
    EXPECT_GE(world.dispatcher.lastStep().worstErrorFraction * double(shape->size()),
              double(boundOf(kCoarse)) * (1 - 1e-5))
        << (isMesh ? "mesh" : "box");
  }
}

TEST(LevelMesh, ASmallBodyRestsOnALargeOneAsOnItsSource) {
  const std::shared_ptr<SphereTreeShape> large = treeShape(ballTree(), 100);
  ASSERT_TRUE(large->setMaxContactError(btScalar(0.009)).ok());
  BulletWorld<> world;
  world.add(large, 0, btVector3(0, 0, 0));
  world.add(treeShape(ballTree(), btScalar(0.1)), 1, btVector3(0, 0, btScalar(100.09)));
  world.world.performDiscreteCollisionDetection();
  EXPECT_GT(world.dispatcher.lastStep().contacts, 0U);
}

TEST(LevelMesh, AnotherErrorCountsFromTheNextStepOn) {
  const std::shared_ptr<SphereTreeShape> shape = shapeFor(0);
  BulletWorld<> world;
  put(world, shape, btQuaternion(0.1, 0.2, 0.3, 0.9), btVector3(0, 0, 0));
  put(world, shape, btQuaternion(0.4, 0.1, 0.2, 0.8), btVector3(btScalar(1.98), 0, 0));
  const Seen fine = lookAt(shape, 0.02, world);
  ASSERT_TRUE(shape->setMaxContactError(1).ok());
  const Seen coarse = lookAt(shape, 0.02, world);
  EXPECT_GT(coarse.error, fine.error + double(boundOf(kCoarse)));
  ASSERT_TRUE(shape->setMaxContactError(0).ok());
  const Seen again = lookAt(shape, 0.02, world);
  EXPECT_EQ(again.depth, fine.depth);
  EXPECT_EQ(again.error, fine.error);
}

}  // namespace
}  // namespace cairn::test::level_mesh_test
