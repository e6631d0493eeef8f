// SPDX-License-Identifier: Zlib
// Steps whose time is up before anything was done: what was said stays, but nothing gets past anything.
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bullet_world.h"
#include "counting_new.h"
#include "terrains.h"
#include "triangle_grounds.h"

namespace cairn::test::late_step_test {
namespace {

constexpr btScalar kRadius = btScalar(0.3);

std::shared_ptr<bullet::SphereTreeShape> roundShape() {
  return treeShape(plainTree(ball(double(kRadius), 6)));
}

std::shared_ptr<btCollisionShape> flatTerrain() {
  auto shape = bullet::TerrainShape::create(terrainGrid({3, 3, 2}, [](double, double) { return 0.0; }));
  if (!shape) throw std::runtime_error(shape.error().message);
  return std::move(shape).value();
}

// It is seen one step late at most, and what stands in where it is first seen forgives how deep it is by then.
TEST(LateSteps, ABodyThatComesFastIsHeldByThePlane) {
  for (const btScalar speed : {1, 3, 5}) {
    SCOPED_TRACE(speed);
    BulletWorld<> w;
    w.addGround();
    ASSERT_TRUE(w.dispatcher.setBudget({{}, 0.0}).ok());
    btRigidBody& body = w.add(roundShape(), 1, btVector3(0, 0, 1));
    body.setLinearVelocity(btVector3(0, 0, -speed));
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(120);
    const btScalar way = speed / 60;
    EXPECT_GT(body.getWorldTransform().getOrigin().z(), kRadius - 2 * way);
    EXPECT_LT(body.getLinearVelocity().length(), 1) << "what holds it drives it";
  }
}

TEST(LateSteps, BodiesThatMeetFastDoNotPass) {
  for (const btScalar speed : {btScalar(0.5), btScalar(3), btScalar(8)}) {
    SCOPED_TRACE(speed);
    BulletWorld<> w;
    w.world.setGravity(btVector3(0, 0, 0));
    ASSERT_TRUE(w.dispatcher.setBudget({{}, 0.0}).ok());
    const auto shape = roundShape();
    btRigidBody& left = w.add(shape, 1, btVector3(-1, 0, 0));
    btRigidBody& right = w.add(shape, 1, btVector3(1, 0, 0));
    left.setLinearVelocity(btVector3(speed, 0, 0));
    right.setLinearVelocity(btVector3(-speed, 0, 0));
    for (int step = 0; step < 240; ++step) {
      w.step();
      EXPECT_GT(right.getWorldTransform().getOrigin().x() - left.getWorldTransform().getOrigin().x(), kRadius)
          << "step " << step;
    }
  }
}

// Motion of a pair that is not looked at adds to its error, until somebody looks.
TEST(LateSteps, AddTheWayToTheError) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  const auto shape = roundShape();
  w.add(shape, 1, btVector3(0, 0, 0));
  btRigidBody& body = w.add(shape, 1, btVector3(btScalar(0.59), btScalar(0.003), btScalar(0.002)));
  w.world.performDiscreteCollisionDetection();
  ASSERT_GT(w.dispatcher.lastStep().contacts, 0U);
  ASSERT_EQ(w.dispatcher.lastStep().unresolvedPairs, 0U);
  ASSERT_TRUE(w.dispatcher.setBudget({{}, 0.0}).ok());
  const btScalar way = btScalar(0.002) * shape->size();  // a step, in which it does not come near the limit
  body.setLinearVelocity(btVector3(0, way * 60, 0));
  w.world.getDispatchInfo().m_timeStep = btScalar(1) / 60;
  double last = w.dispatcher.lastStep().worstErrorFraction;
  int grown = 0;
  for (int step = 1; step <= 6; ++step) {
    body.getWorldTransform().getOrigin() += btVector3(0, way, 0);
    w.world.performDiscreteCollisionDetection();
    const auto& s = w.dispatcher.lastStep();
    if (s.unresolvedPairs == 0) continue;  // no pair waits for ever
    EXPECT_GT(s.contacts, 0U);
    grown += s.worstErrorFraction >= last + 0.9 * 0.002;
    last = s.worstErrorFraction;
  }
  EXPECT_GE(grown, 5);
}

// Bodies without speeds, as in a world that only collides: whatever they are moved to is seen after some steps.
TEST(LateSteps, WhatIsMovedByHandIsLookedAt) {
  constexpr int kPairs = 40, kSteps = 8;
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  const auto shape = roundShape();
  std::vector<btRigidBody*> second;
  for (int i = 0; i < kPairs; ++i) {
    w.add(shape, 1, btVector3(btScalar(3 * i), 0, 0));
    second.push_back(&w.add(shape, 1, btVector3(btScalar(3 * i), btScalar(0.62), 0)));
  }
  ASSERT_TRUE(w.dispatcher.setBudget({{}, 0.0}).ok());
  w.world.performDiscreteCollisionDetection();
  for (btRigidBody* body : second) body->getWorldTransform().getOrigin().setY(btScalar(0.3));
  std::set<const btCollisionObject*> met;
  for (int step = 0; step < kSteps; ++step) {
    w.world.performDiscreteCollisionDetection();
    for (int m = 0; m < w.dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold* const manifold = w.dispatcher.getManifoldByIndexInternal(m);
      if (manifold->getNumContacts() > 0) met.insert(manifold->getBody0());
    }
  }
  EXPECT_EQ(met.size(), std::size_t{kPairs});
}

// A callback sets a deadline while the pairs of the step are being worked on.
TEST(LateSteps, ADeadlineSetInACallbackHoldsFromTheNextStepOn) {
  static BulletWorld<>* world = nullptr;
  BulletWorld<> w;
  w.addGround();
  world = &w;
  const auto shape = roundShape();
  for (int i = 0; i < 12; ++i) w.add(shape, 1, btVector3(btScalar(0.5) * btScalar(i), 0, btScalar(0.29)));
  ASSERT_TRUE(w.dispatcher.setBudget({20000, {}}).ok());
  gContactStartedCallback = [](btPersistentManifold* const&) {
    ASSERT_TRUE(world->dispatcher.setBudget({{}, 500.0}).ok());
    world->dispatcher.expectPairs({.trees = 1000, .terrains = 1000});
  };
  w.step(5);
  gContactStartedCallback = nullptr;
  EXPECT_GT(w.dispatcher.lastStep().contacts, 0U);
}

// The pairs of eight balls and a plane, which all meet in the first step; each pair has three lists at least.
TEST(LateSteps, PairsThatWereExpectedAreNotMadeInTheStep) {
  if (!countsAllocations()) GTEST_SKIP() << "the sanitizer owns new";
  constexpr std::size_t kBalls = 8, kTrees = kBalls * (kBalls - 1) / 2;
  const auto inFirstStep = [&](bool isExpected) {
    BulletWorld<> w;
    w.addGround();
    if (isExpected) w.dispatcher.expectPairs({.trees = kTrees, .planes = kBalls});
    const auto shape = roundShape();
    for (std::size_t i = 0; i < kBalls; ++i)
      w.add(shape, 1, btVector3(btScalar(0.02) * btScalar(i), 0, btScalar(0.9) * kRadius));
    const std::size_t before = allocations();
    w.world.performDiscreteCollisionDetection();
    EXPECT_EQ(w.dispatcher.lastStep().pairs, kTrees + kBalls);
    return allocations() - before;
  };
  const std::size_t unexpected = inFirstStep(false), expected = inFirstStep(true);
  EXPECT_GE(unexpected, expected + 3 * (kTrees + kBalls)) << expected;
}

// One ball and one ground of each kind: expected as itself it saves lists, expected as another kind it does not.
TEST(LateSteps, ExpectedPairsAreOfTheKindThatTheyAreNamedBy) {
  if (!countsAllocations()) GTEST_SKIP() << "the sanitizer owns new";
  using bullet::ExpectedPairs;
  const std::vector<btVector3> corners{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const std::vector<std::pair<std::shared_ptr<btCollisionShape>, ExpectedPairs>> grounds{
      {std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)), {.planes = 8}},
      {std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.001))), {.convexShapes = 8}},
      {meshOf(corners), {.triangleMeshes = 8}},
      {flatTerrain(), {.terrains = 8}}};
  const auto inFirstStep = [](const std::shared_ptr<btCollisionShape>& ground, const ExpectedPairs& expected) {
    BulletWorld<> w;
    w.add(ground, 0, btVector3(0, 0, 0));
    w.dispatcher.expectPairs(expected);
    w.add(roundShape(), 1, btVector3(0, 0, btScalar(0.9) * kRadius));
    const std::size_t before = allocations();
    w.world.performDiscreteCollisionDetection();
    EXPECT_EQ(w.dispatcher.lastStep().pairs, 1U);
    return allocations() - before;
  };
  for (const auto& [ground, own] : grounds) {
    inFirstStep(ground, own);  // what a shape makes once
    const std::size_t asItself = inFirstStep(ground, own);
    for (const auto& [other, others] : grounds)
      if (other != ground)
        EXPECT_GT(inFirstStep(ground, others), asItself) << ground->getName() << ", expected " << other->getName();
  }
}

}  // namespace
}  // namespace cairn::test::late_step_test
