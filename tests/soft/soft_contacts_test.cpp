// SPDX-License-Identifier: Zlib
// Soft bodies of Bullet's that meet sphere-trees.
#include "cairn/soft/soft_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <utility>

#include "cairn/core/state_hash.h"
#include "moving_meshes.h"
#include "soft_world.h"

namespace cairn::test {
namespace {

constexpr double kMargin = double(SoftWorld::kMargin);

TEST(SoftContacts, AClothLiesOnATorusAndHangsThroughItsHole) {
  SoftWorld world;
  const auto torus = treeShape(test::torus(0.7, 0.25, 32));
  world.add(torus, 0, at(0, 0, 0));
  btSoftBody& cloth = world.addCloth({0, 0, btScalar(0.5)}, btScalar(0.9), 30, 1, false);
  world.run(240);
  EXPECT_LT(deepestNode(cloth, *torus, at(0, 0, 0)), 0) << "a node is inside";
  EXPECT_GT(deepestNode(cloth, *torus, at(0, 0, 0)), -1.5 * kMargin) << "it does not lie on it";
  const btVector3 middle = cloth.m_nodes[15 * 31 + 15].m_x;
  EXPECT_LT(double(middle.z()), 0.2) << "the hole is filled";
  EXPECT_GT(double(lowest(cloth)), -1.2) << "it fell off";
}

TEST(SoftContacts, AThinPlateHoldsFastNodes) {
  SoftWorld world;
  const auto plate = treeShape(test::cuboid({4, 4, 0.005}, 4));
  world.add(plate, 0, at(0, 0, 0));
  btSoftBody* const ball = btSoftBodyHelpers::CreateEllipsoid(world.world.getWorldInfo(), {0, 0, 1},
                                                              {btScalar(0.5), btScalar(0.5), btScalar(0.5)}, 200);
  ball->m_cfg.kPR = 20;
  world.add(ball, 1);
  ball->setVelocity({0, 0, -40});  // two thirds of a metre a step, its own width in one and a half
  world.run(60);
  EXPECT_GT(lowest(*ball), 0);
}

// Weightless, so that nothing else gives momentum to either.
TEST(SoftContacts, WhatATreeLosesAClothGains) {
  SoftWorld world({0, 0, 0});
  btRigidBody& ring = world.add(treeShape(test::torus(0.5, 0.2, 24)), 2, at(0, 0, 1));
  ring.setLinearVelocity({0, 0, -3});
  ring.setDamping(0, 0);
  btSoftBody& cloth = world.addCloth({0, 0, 0}, 1, 20, 1, false);
  world.run(60);
  double momentum = double(ring.getLinearVelocity().z()) * 2;
  for (int i = 0; i < cloth.m_nodes.size(); ++i)
    momentum += double(cloth.m_nodes[i].m_v.z()) / double(cloth.m_nodes[i].m_im);
  EXPECT_GT(double(ring.getLinearVelocity().z()), -2.6) << "it was not braked";
  EXPECT_NEAR(momentum, -6, 0.12);  // two per cent: positions are solved, and velocities follow from them
}

TEST(SoftContacts, ATrampolineHoldsATree) {
  SoftWorld world;
  const auto ring = treeShape(test::torus(0.4, 0.15, 24));
  btRigidBody& body = world.add(ring, btScalar(0.5), at(0, 0, btScalar(0.6)));
  btSoftBody& cloth = world.addCloth({0, 0, 0}, 1, 20, 1, true);
  world.run(300);
  EXPECT_GT(double(body.getWorldTransform().getOrigin().z()), lowest(cloth));
  EXPECT_GT(double(body.getWorldTransform().getOrigin().z()), -0.8);
  EXPECT_LT(deepestNode(cloth, *ring, body.getWorldTransform()), 0.05);  // half a cell: between nodes nothing is tested
}

// The same ball on the same trampoline, as Bullet's hull and as a tree.
TEST(SoftContacts, HoldABallAtLeastAsHighAsBulletsHull) {
  const Solid solid = test::ball(0.3, 3);
  const auto tree = treeShape(solid);
  const auto hull = std::make_shared<btConvexHullShape>();
  for (const Vec3d& v : solid.vertices) hull->addPoint(btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z)));
  hull->setMargin(0);
  const auto fallen = [&](const std::shared_ptr<btCollisionShape>& shape) {
    SoftWorld world;
    const btRigidBody& body = world.add(shape, btScalar(0.5), at(0, 0, btScalar(0.6)));
    const btSoftBody& cloth = world.addCloth({0, 0, 0}, 1, 20, 1, true);
    world.run(300);
    return std::pair(deepestNode(cloth, *tree, body.getWorldTransform()),
                     double(body.getWorldTransform().getOrigin().z()));
  };
  const auto [deepAsHull, heightAsHull] = fallen(hull);
  const auto [deepAsTree, heightAsTree] = fallen(tree);
  std::printf("deepest node %.4f m as a hull, %.4f m as a tree; height %.3f, %.3f m\n", deepAsHull, deepAsTree,
              heightAsHull, heightAsTree);
  EXPECT_LT(deepAsTree, std::max(deepAsHull, 0.0) + kMargin);
  EXPECT_GT(heightAsTree, heightAsHull - kMargin);
}

TEST(SoftContacts, ScaleMarginAndCompoundsCount) {
  SoftWorld world;
  const auto slab = treeShape(test::cuboid({1, 1, 0.1}, 2), 3);  // 3 x 3 x 0.3 m
  slab->setMargin(btScalar(0.04));
  const auto compound = std::make_shared<btCompoundShape>();
  compound->addChildShape(at(0, 0, btScalar(0.5)), slab.get());
  world.add(compound, 0, at(0, 0, 1));  // its top at 1.65
  btSoftBody& cloth = world.addCloth({0, 0, 2}, 1, 12, 1, false);
  world.run(180);
  EXPECT_NEAR(lowest(cloth), 1.65 + 0.04 + kMargin, 0.01);
}

TEST(SoftContacts, AMeshThatMovesPushesACloth) {
  SoftWorld world;
  const MovingMesh breathing{"ball", test::ball(0.5, 3),
                             [](const Vec3d& p, double phase) { return p * (1 + 0.5 * std::sin(phase)); }};
  const auto ball = treeShape(breathing.first);
  const SphereTree first = ball->tree();
  world.addKinematic(ball);
  btSoftBody& cloth = world.addCloth({0, 0, btScalar(0.6)}, 1, 20, 1, true);
  world.run(60);
  double highest = 0;
  for (int i = 0; i <= 60; ++i) {
    ASSERT_TRUE(ball->setVertices(breathing.inTree(first, i / 60.0 * std::numbers::pi / 2)));
    world.run(1);
  }
  for (int i = 0; i < cloth.m_nodes.size(); ++i) highest = std::max(highest, double(cloth.m_nodes[i].m_x.z()));
  EXPECT_GT(highest, 0.74);                                 // the ball's top is at 0.75
  EXPECT_LT(deepestNode(cloth, *ball, at(0, 0, 0)), 0.05);  // half a cell: links are solved after contacts
}

TEST(SoftContacts, RunsEndInTheSameBits) {
  const auto run = [] {
    SoftWorld world;
    world.add(treeShape(test::torus(0.7, 0.25, 24)), 0, at(0, 0, 0));
    btRigidBody& second = world.add(treeShape(test::ball(0.3, 2)), 1, at(0, 0, 2));
    const btSoftBody& cloth = world.addCloth({0, 0, btScalar(0.5)}, btScalar(0.9), 20, 1, false);
    world.run(120);
    StateHash hash;
    for (int i = 0; i < cloth.m_nodes.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) hash.add(cloth.m_nodes[i].m_x[axis]);
    for (int axis = 0; axis < 3; ++axis) hash.add(second.getWorldTransform().getOrigin()[axis]);
    return hash.value();
  };
  EXPECT_EQ(run(), run());
}

// It is one whether a body moves or a plate does.
TEST(SoftContacts, AThinPlateThatMovesPassesNoNode) {
  for (const btScalar speed : {btScalar(2), btScalar(10), btScalar(20)}) {
    SCOPED_TRACE(double(speed));
    SoftWorld world({0, 0, 0});
    const auto plate = treeShape(test::cuboid({4, 4, 0.005}, 4));
    btRigidBody& body = world.add(plate, 1000, at(0, 0, 2));
    body.setLinearVelocity({0, 0, -speed});
    btSoftBody* const ball = btSoftBodyHelpers::CreateEllipsoid(world.world.getWorldInfo(), {0, 0, 0},
                                                                {btScalar(0.5), btScalar(0.5), btScalar(0.5)}, 200);
    ball->m_cfg.kPR = 20;
    world.add(ball, 1);
    for (double gone = 0; gone < 3; gone += double(speed * kStep)) world.run(1);
    double highest = -1e9;
    for (int i = 0; i < ball->m_nodes.size(); ++i) highest = std::max(highest, double(ball->m_nodes[i].m_x.z()));
    EXPECT_LT(highest, double(body.getWorldTransform().getOrigin().z()));
  }
}

// Faster than Bullet's solver knows: it has no velocity of a mesh that moves by itself.
TEST(SoftContacts, AMeshThatRisesLiftsACloth) {
  for (const double speed : {0.5, 2.0, 4.0}) {
    SCOPED_TRACE(speed);
    SoftWorld world;
    const MovingMesh rising{"slab", test::cuboid({4, 4, 0.05}, 4), [](const Vec3d& p, double phase) {
                              return p + Vec3d{0, 0, phase};
                            }};
    const auto slab = treeShape(rising.first);
    const SphereTree first = slab->tree();
    world.addKinematic(slab);
    btSoftBody& cloth = world.addCloth({0, 0, btScalar(0.1)}, 1, 10, 1, false);
    world.run(60);
    double height = 0;
    for (int i = 0; i < 60; ++i) {
      height += speed * double(kStep);
      ASSERT_TRUE(slab->setVertices(rising.inTree(first, height)));
      world.run(1);
    }
    EXPECT_GT(lowest(cloth), height) << "nodes are below the slab's middle";
  }
}

TEST(SoftContacts, AskWhatBulletAsks) {
  const auto lowestWith = [](int flags, bool anchored) {
    SoftWorld world;
    btRigidBody& plate = world.add(treeShape(test::cuboid({4, 4, 0.2}, 4)), 0, at(0, 0, 0));
    btSoftBody& cloth = world.addCloth({0, 0, btScalar(0.4)}, 1, 12, 1, false);
    cloth.m_cfg.collisions = flags;
    if (anchored) cloth.appendAnchor(0, &plate, true);
    world.run(90);
    return lowest(cloth);
  };
  EXPECT_GT(lowestWith(btSoftBody::fCollision::SDF_RS, false), 0.1);
  EXPECT_LT(lowestWith(0, false), -1) << "a body that collides with nothing";
  EXPECT_LT(lowestWith(btSoftBody::fCollision::SDF_RS, true), -0.1) << "a body anchored to what it is not to meet";
}

// While they are off, a body may go anywhere: what it passes then counts for nothing.
TEST(SoftContacts, FlagsThatGoOnAgainBeginAnew) {
  SoftWorld world({0, 0, 0});
  btRigidBody& body = world.addKinematic(treeShape(test::cuboid({4, 4, 0.1}, 4)));
  btSoftBody& cloth = world.addCloth({0, 0, btScalar(0.2)}, 1, 8, 1, false);
  world.run(2);
  cloth.m_cfg.collisions = 0;
  world.run(1);
  body.setWorldTransform(at(0, 0, btScalar(0.4)));  // past the cloth, which is below it now
  world.run(2);
  cloth.m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
  world.run(2);
  EXPECT_LT(lowest(cloth), 0.3);
}

TEST(SoftContacts, AShapeMayBeExchangedWhileItsPairLives) {
  SoftWorld world;
  const auto ball = treeShape(test::ball(0.5, 3)), slab = treeShape(test::cuboid({3, 3, 0.2}, 1));
  const auto box = std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.1)));
  btRigidBody& body = world.add(ball, 0, at(0, 0, 0));
  btSoftBody& cloth = world.addCloth({0, 0, btScalar(0.6)}, 1, 12, 1, false);
  world.run(20);
  body.setCollisionShape(slab.get());
  world.run(20);
  body.setCollisionShape(box.get());
  world.run(20);
  body.setCollisionShape(ball.get());
  EXPECT_TRUE(std::isfinite(lowest(cloth)));
}

TEST(SoftContacts, AreInstalledOnceAndGiveBackTheirOwnAlone) {
  SoftWorld world;
  const auto second = soft::SoftContacts::install(world.dispatcher);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("already"), std::string::npos);
  { const soft::SoftContacts taken = std::move(world.contacts); }
  auto again = soft::SoftContacts::install(world.dispatcher);
  ASSERT_TRUE(again);
  world.contacts = std::move(again).value();
  world.add(treeShape(test::cuboid({4, 4, 0.2}, 4)), 0, at(0, 0, 0));
  btSoftBody& cloth = world.addCloth({0, 0, btScalar(0.4)}, 1, 12, 1, false);
  world.run(120);
  EXPECT_GT(lowest(cloth), 0.1);
}

TEST(SoftContacts, GiveBulletsAlgorithmBack) {
  SoftWorld world;
  const auto plate = treeShape(test::cuboid({4, 4, 0.2}, 4));
  world.add(plate, 0, at(0, 0, 0));
  { const soft::SoftContacts taken = std::move(world.contacts); }
  btSoftBody& cloth = world.addCloth({0, 0, 1}, 1, 12, 1, false);
  world.run(180);
  EXPECT_LT(lowest(cloth), 0.09) << "Bullet's prisms let nodes in";
}

TEST(SoftContacts, RefuseAConfigurationWithoutSoftBodies) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  const auto refused = soft::SoftContacts::install(dispatcher);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("btSoftBodyRigidBodyCollisionConfiguration"), std::string::npos);
}

}  // namespace
}  // namespace cairn::test
