// SPDX-License-Identifier: Zlib
// Pairs that lie still are carried over: the kernel is asked again when the bodies have moved against each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bullet_world.h"
#include "test_trees.h"

namespace cairn::test::carried_pair_test {
namespace {

// A crate on a larger one, which does not move by itself.
struct Stack {
  BulletWorld<> w;
  btRigidBody *floor = nullptr, *crate = nullptr;

  Stack() {
    w.dispatcher.setFinest(bullet::Finest::triangles);
    const auto shape = [](const Vec3d& size) {
      auto created = bullet::SphereTreeShape::create(plainTree(cuboid(size, 2), 4));
      return std::shared_ptr<bullet::SphereTreeShape>(std::move(created).value());
    };
    floor = &w.add(shape({3, 3, 1}), 0, btVector3(0, 0, 0));
    crate = &w.add(shape({1, 1, 1}), 1, btVector3(0, 0, btScalar(1.001)));
    crate->setActivationState(DISABLE_DEACTIVATION);
    w.step(120);
  }
  bool wasAsked() { return w.dispatcher.lastStep().operations > 0; }
  // Of the lowest point of the crate above the floor, by its contacts.
  btScalar deepest() const {
    btScalar depth = 0;
    for (int m = 0; m < w.dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(m);
      for (int i = 0; i < manifold.getNumContacts(); ++i)
        depth = std::max(depth, -manifold.getContactPoint(i).getDistance());
    }
    return depth;
  }
};

TEST(CarriedPair, IsAskedAgainOnceItHasMoved) {
  Stack stack;
  const btScalar height = stack.crate->getWorldTransform().getOrigin().z();
  int asked = 0;
  for (int step = 0; step < 60; ++step) {
    stack.w.step();
    asked += stack.wasAsked() ? 1 : 0;
    EXPECT_GE(stack.w.dispatcher.lastStep().contacts, 3U);
    EXPECT_EQ(stack.w.dispatcher.lastStep().exactContacts, stack.w.dispatcher.lastStep().contacts);
  }
  EXPECT_LE(asked, 6) << "of 60 steps in which nothing moved";
  EXPECT_NEAR(stack.crate->getWorldTransform().getOrigin().z(), height, 1e-4);
  // By less than a contact distance, which is 3.5 mm here, and more than half of it.
  stack.crate->getWorldTransform().getOrigin() += btVector3(btScalar(0.002), 0, 0);
  stack.w.step();
  EXPECT_TRUE(stack.wasAsked());
  stack.crate->getWorldTransform().getOrigin() += btVector3(0, 0, btScalar(0.1));
  stack.w.step();
  EXPECT_EQ(stack.w.dispatcher.lastStep().contacts, 0U) << "it hangs in the air";
}

// However slowly: what is carried over is never older than the tolerance.
TEST(CarriedPair, IsAskedAgainWhenItCreeps) {
  Stack stack;
  stack.w.world.setGravity(btVector3(0, 0, 0));
  int asked = 0;
  for (int step = 0; step < 100; ++step) {
    stack.crate->getWorldTransform().getOrigin() += btVector3(btScalar(5e-4), 0, 0);
    stack.crate->setLinearVelocity(btVector3(0, 0, 0));
    stack.w.step();
    asked += stack.wasAsked() ? 1 : 0;
  }
  EXPECT_GE(asked, 20) << "it crept 5 cm, which is 29 times the tolerance";
  EXPECT_LE(asked, 50) << "and lay still for most of it";
}

// A game may make a body slippery while it lies on a slope.
TEST(CarriedPair, KnowsTheBodiesFriction) {
  Stack stack;
  stack.w.world.setGravity(btVector3(btScalar(3), 0, btScalar(-10)));
  stack.crate->setFriction(1);
  stack.floor->setFriction(1);
  stack.w.step(60);
  EXPECT_LT(std::abs(stack.crate->getLinearVelocity().x()), btScalar(0.01));
  stack.crate->setFriction(0);
  stack.w.step(30);
  EXPECT_NEAR(stack.crate->getLinearVelocity().x(), 1.5, 0.05);
}

// Memory that is given back at once where nothing is carried over.
TEST(CarriedPair, IsAskedAgainWhenItsPointsAreTaken) {
  Stack stack;
  stack.w.step();
  for (int m = 0; m < stack.w.dispatcher.getNumManifolds(); ++m)
    stack.w.dispatcher.getManifoldByIndexInternal(m)->clearManifold();
  stack.w.step();
  EXPECT_GE(stack.w.dispatcher.lastStep().contacts, 3U);
}

// A margin is part of a body: one wider than a contact distance counts before the meshes cross.
TEST(CarriedPair, RestsOnItsMargin) {
  Stack stack;
  for (btRigidBody* body : {stack.floor, stack.crate}) body->getCollisionShape()->setMargin(btScalar(0.01));
  stack.crate->getWorldTransform().setOrigin(btVector3(0, 0, btScalar(1.01)));
  stack.w.step(60);
  EXPECT_NEAR(stack.crate->getWorldTransform().getOrigin().z(), 1.02, 0.003);
}

// Bodies that move together lie still against each other; their points go with them.
TEST(CarriedPair, GoesAlongWithWhatCarriesIt) {
  Stack stack;
  const btVector3 way(btScalar(0.02), btScalar(-0.03), btScalar(0.01));
  const btQuaternion turn(btVector3(0, 0, 1), btScalar(0.02));
  int asked = 0;
  for (int step = 0; step < 30; ++step) {
    for (btRigidBody* body : {stack.floor, stack.crate}) {
      const btTransform along(turn, way);
      body->setWorldTransform(along * body->getWorldTransform());
      body->setInterpolationWorldTransform(body->getWorldTransform());
    }
    stack.w.world.performDiscreteCollisionDetection();
    asked += stack.wasAsked() ? 1 : 0;
    EXPECT_GE(stack.w.dispatcher.lastStep().contacts, 3U);
    EXPECT_LT(stack.deepest(), btScalar(0.0035));
    const btPersistentManifold& manifold = *stack.w.dispatcher.getManifoldByIndexInternal(0);
    const btManifoldPoint& point = manifold.getContactPoint(0);
    const btTransform& floor = stack.floor->getWorldTransform();
    EXPECT_NEAR(floor.invXform(point.getPositionWorldOnB()).z(), 0.5, 0.004);
    EXPECT_GT(std::abs(floor.getBasis().getColumn(2).dot(point.m_normalWorldOnB)), btScalar(0.999));
  }
  EXPECT_LE(asked, 10);
}

}  // namespace
}  // namespace cairn::test::carried_pair_test
