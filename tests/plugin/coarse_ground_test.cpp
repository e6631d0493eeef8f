// SPDX-License-Identifier: Zlib
// The fallback for bodies on a terrain when a step has no budget left.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "cairn/core/budget.h"
#include "front_ends.h"
#include "pairs/coarse_ground.h"
#include "terrains.h"
#include "test_solids.h"

namespace cairn::test::coarse_ground_test {
namespace {

using bullet::CoarseGround;

constexpr std::uint64_t kSeed = 31;
constexpr int kTrials = 300;
// Of poses in float, tens of metres from the origins, and normals of unit length.
constexpr double kRounding = 1e-4;

btTransform randomPose(std::mt19937_64& engine, double low, double high) {
  const btQuaternion turned(btScalar(uniform(engine, -1, 1)), btScalar(uniform(engine, -1, 1)),
                            btScalar(uniform(engine, -1, 1)), btScalar(uniform(engine, 0.1, 1)));
  return btTransform(turned.normalized(), btVector3(btScalar(uniform(engine, -8, 8)), btScalar(uniform(engine, -8, 8)),
                                                    btScalar(uniform(engine, low, high))));
}

struct TreeOverTerrain {
  std::mt19937_64 engine;
  std::shared_ptr<bullet::TerrainShape> ground;
  std::shared_ptr<bullet::SphereTreeShape> tree = treeShape(plainTree(test::ball(0.7, 8)));
  btCollisionObject body, groundBody;
  double low = 0, high = 0;

  explicit TreeOverTerrain(std::uint64_t seed) : engine(seed), ground(terrainOf(randomTerrain(engine, {24, 24, 1}))) {
    low = double(ground->lower().z());
    high = double(ground->upper().z());
    body.setCollisionShape(tree.get());
    groundBody.setCollisionShape(ground.get());
  }
  void place() {
    body.setWorldTransform(randomPose(engine, low - 1, high + 1));
    btTransform tilted = btTransform::getIdentity();
    tilted.setRotation(btQuaternion(btVector3(1, 2, 0).normalized(), btScalar(uniform(engine, -0.3, 0.3))));
    tilted.setOrigin(btVector3(btScalar(uniform(engine, -1, 1)), 0, btScalar(uniform(engine, -1, 1))));
    groundBody.setWorldTransform(tilted);
  }
  btCollisionObjectWrapper wrapper(const btCollisionObject& object) const {
    return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
  }
  // In the ground's frame.
  template <class Visit>
  void forEachVertex(const Visit& visit) const {
    const btTransform toGround = groundBody.getWorldTransform().inverse() * body.getWorldTransform();
    for (const Vec3& v : tree->tree().vertices())
      visit(toGround * (tree->bodyFromTree() * (btVector3(v.x, v.y, v.z) * tree->scale())));
  }
  double fromNearestVertex(const btVector3& inGround) const {
    double nearest = std::numeric_limits<double>::infinity();
    forEachVertex([&](const btVector3& v) { nearest = std::min(nearest, double((v - inGround).length())); });
    return nearest;
  }
  // The contact's point of the body, in the ground's frame.
  btVector3 inGround(const bullet::Contact& contact) const {
    const Vec3 onTree = contact.onTree();
    const btVector3 world = body.getWorldTransform().getOrigin() + btVector3(onTree.x, onTree.y, onTree.z);
    return groundBody.getWorldTransform().inverse() * world;
  }
};

// Each contact is a vertex of the body, as far from the plane below it as it says; none claims more than all vertices
// one by one do.
TEST(CoarseGround, SaysNothingThatIsNotTrue) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  TreeOverTerrain s(kSeed);
  constexpr btScalar kReach = btScalar(0.05);
  int contacts = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    s.place();
    CoarseGround coarse(s.wrapper(s.body), s.wrapper(s.groundBody), kReach);
    for (const bullet::Contact& contact : coarse.contacts()) {
      ++contacts;
      const btVector3 point = s.inGround(contact);
      EXPECT_LT(s.fromNearestVertex(point), kRounding);
      const auto height = s.ground->heightAt(double(point.x()), double(point.y()));
      const auto normal = s.ground->normalAt(double(point.x()), double(point.y()));
      ASSERT_TRUE(height && normal);
      const btVector3 world = s.groundBody.getWorldTransform().getBasis() * *normal;
      EXPECT_LT((world - btVector3(contact.normal.x, contact.normal.y, contact.normal.z)).length(), kRounding);
      EXPECT_NEAR(double(contact.separation), (double(point.z()) - *height) * double(normal->z()), kRounding);
      EXPECT_LT(contact.separation, kReach);
    }
    for (std::size_t i = 1; i < coarse.contacts().size(); ++i)
      EXPECT_LE(coarse.contacts()[i - 1].separation, coarse.contacts()[i].separation) << "nearest first";
  }
  EXPECT_GT(contacts, kTrials / 3) << "hardly any: the test shows nothing";
}

// Over one plane there is one direction: the deepest of all the support points that the root's children keep.
TEST(CoarseGround, FindsTheDeepestSupportPointOverOneSlope) {
  const auto slope = terrainOf(terrainGrid({30, 30, 1}, [](double x, double y) { return 0.4 * x + 0.1 * y; }));
  TreeOverTerrain s(kSeed);
  s.groundBody.setCollisionShape(slope.get());
  s.groundBody.setWorldTransform(btTransform::getIdentity());
  const SphereTree& tree = s.tree->tree();
  const double upwards = double(slope->normalAt(0, 0)->z());
  for (int trial = 0; trial < kTrials; ++trial) {
    btTransform pose = randomPose(s.engine, 0, 0);
    const auto height = slope->heightAt(double(pose.getOrigin().x()), double(pose.getOrigin().y()));
    pose.getOrigin().setZ(btScalar(*height + uniform(s.engine, 0, 0.6)));
    s.body.setWorldTransform(pose);
    double deepest = 1e9;
    for (const NodeId node : tree.levelCut(1))
      for (const Vec3& point : tree.supportPoints(node)) {
        const btVector3 v = pose * (s.tree->bodyFromTree() * (btVector3(point.x, point.y, point.z) * s.tree->scale()));
        deepest = std::min(deepest, upwards * (double(v.z()) - *slope->heightAt(double(v.x()), double(v.y()))));
      }
    ASSERT_LT(deepest, 0) << "the test means bodies that touch";
    CoarseGround coarse(s.wrapper(s.body), s.wrapper(s.groundBody), btScalar(0.05));
    ASSERT_FALSE(coarse.contacts().empty());
    EXPECT_NEAR(double(coarse.contacts().front().separation), deepest, kRounding);
  }
}

TEST(CoarseGround, IsClearOnlyWhereNoVertexIsNear) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  TreeOverTerrain s(kSeed);
  const double reach = bullet::kSpeculativeFraction * double(s.tree->size());
  int clear = 0;
  for (int trial = 0; trial < 10 * kTrials; ++trial) {
    s.place();
    const btScalar travel = btScalar(uniform(s.engine, 0, 0.3));
    if (!bullet::isClearOfGround(s.wrapper(s.body), s.wrapper(s.groundBody), travel)) continue;
    ++clear;
    s.forEachVertex([&](const btVector3& v) {
      const auto height = s.ground->heightAt(double(v.x()), double(v.y()));
      const auto normal = s.ground->normalAt(double(v.x()), double(v.y()));
      if (height) EXPECT_GT((double(v.z()) - *height) * double(normal->z()), reach + double(travel));
    });
  }
  EXPECT_GT(clear, kTrials) << "hardly ever: the test shows nothing";
}

CAIRN_FRONT_END_SUITE(BudgetOnTerrain, EveryFrontEnd);

// Sixty balls roll down a slope on a budget that brings one pair a step up to date: all lie on the ground all the time,
// however little there is.
TYPED_TEST(BudgetOnTerrain, NothingSinksWhateverIsLeft) {
  constexpr btScalar kBall = btScalar(0.4);
  BulletWorld<TypeParam> w;
  const auto ground = terrainOf(terrainGrid(
      {60, 60, 1}, [](double x, double y) { return 0.3 * x + 0.15 * std::sin(1.3 * x) + 0.1 * std::cos(0.9 * y); }));
  w.add(ground, 0, btVector3(0, 0, 0));
  const auto ball = treeShape(plainTree(test::ball(double(kBall), 8)));
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < 60; ++i) {
    const double x = 8 + i % 6 * 1.6, y = -12 + i / 6 * 2.4;
    bodies.push_back(&w.add(ball, 1, btVector3(btScalar(x), btScalar(y), btScalar(*ground->heightAt(x, y) + 0.6))));
  }
  EXPECT_TRUE(w.dispatcher.setBudget({1, {}}).ok());
  double deepest = 0;
  std::uint32_t unresolved = 0;
  for (int step = 0; step < 150; ++step) {
    w.step(1);
    unresolved = std::max(unresolved, w.dispatcher.lastStep().unresolvedPairs);
    for (const btRigidBody* body : bodies) {
      const btVector3& at = body->getWorldTransform().getOrigin();
      const auto height = ground->heightAt(double(at.x()), double(at.y()));
      ASSERT_TRUE(height);
      const double over = (double(at.z()) - *height) * double(ground->normalAt(double(at.x()), double(at.y()))->z());
      deepest = std::max(deepest, double(kBall) - over);
    }
  }
  EXPECT_GT(unresolved, 40U) << "nothing had to wait: the test shows nothing";
  // A body that falls at 3 m/s comes 5 cm farther in a step before it is stopped; slopes bend by a part of the ball.
  EXPECT_LT(deepest, 0.25 * 2 * double(kBall));
  std::printf("at most %.3f of a ball's diameter deep\n", deepest / (2 * double(kBall)));
}

// Bodies that ask for continuous collision are stopped at the ground even if nobody has time for their course.
TYPED_TEST(BudgetOnTerrain, FastBodiesAreStoppedWhateverIsLeft) {
  constexpr btScalar kBall = btScalar(0.2);
  BulletWorld<TypeParam> w;
  const auto ground = terrainOf(terrainGrid({60, 60, 1}, [](double x, double) { return 0.2 * x; }));
  w.add(ground, 0, btVector3(0, 0, 0));
  const auto ball = treeShape(plainTree(test::ball(double(kBall), 8)));
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < 40; ++i) {
    const double x = -20 + i % 8 * 5, y = -20 + i / 8 * 8;
    const btScalar height = btScalar(*ground->heightAt(x, y) + 1 + 0.1 * i);
    bodies.push_back(&w.add(ball, 1, btVector3(btScalar(x), btScalar(y), height)));
    bodies.back()->setCcdMotionThreshold(btScalar(0.05));
    bodies.back()->setLinearVelocity(btVector3(0, 0, btScalar(-60)));  // five times its size in a step
  }
  EXPECT_TRUE(w.dispatcher.setBudget({1, {}}).ok());
  double lowest = 1e9;
  for (int step = 0; step < 60; ++step) {
    w.step(1);
    for (const btRigidBody* body : bodies) {
      const btVector3& at = body->getWorldTransform().getOrigin();
      if (const auto height = ground->heightAt(double(at.x()), double(at.y())))
        lowest = std::min(lowest, double(at.z()) - *height);
    }
  }
  // Where a single point stops it, it turns about that by some of its size.
  EXPECT_GT(lowest, 0);
  std::printf("centres no lower than %.3f of a ball's radius above the ground\n", lowest / double(kBall));
}

// Also what was slow when it was last looked at, and has hardly moved since.
TYPED_TEST(BudgetOnTerrain, WhatIsStruckWhereItHoversIsStopped) {
  BulletWorld<TypeParam> w;
  w.world.setGravity(btVector3(0, 0, 0));
  const auto ground = terrainOf(terrainGrid({60, 60, 1}, [](double x, double) { return x == 0 ? 3 : 0; }));
  w.add(ground, 0, btVector3(0, 0, 0));
  const auto rod = treeShape(plainTree(cuboid({2, 0.2, 0.2}, 3)));
  std::vector<btRigidBody*> struck;
  for (int i = 0; i < 20; ++i) {
    const btScalar x = btScalar(-20 + i % 5 * 5), y = btScalar(-20 + i / 5 * 8);
    w.add(rod, 1, btVector3(x, y + 2, btScalar(0.1)));  // what takes the budget
    struck.push_back(&w.add(rod, 1, btVector3(x, y, btScalar(0.5))));
    struck.back()->setCcdMotionThreshold(btScalar(0.05));
  }
  EXPECT_TRUE(w.dispatcher.setBudget({1000000, {}}).ok());
  w.step(1);
  for (btRigidBody* body : struck) body->setLinearVelocity(btVector3(0, 0, btScalar(-100)));
  EXPECT_TRUE(w.dispatcher.setBudget({1, {}}).ok());
  w.step(1);
  EXPECT_GT(w.dispatcher.lastStep().unresolvedPairs, 30U) << "nothing had to wait: the test shows nothing";
  for (const btRigidBody* body : struck) EXPECT_GT(body->getWorldTransform().getOrigin().z(), 0);
}

// Where a body stood before it was held says nothing of where it comes from: the straight way between leads through
// hills.
TYPED_TEST(BudgetOnTerrain, WhatHasPassedAHillIsNotPushedBackThroughIt) {
  BulletWorld<TypeParam> w;
  const auto ground = terrainOf(
      terrainGrid({200, 60, 1}, [](double x, double y) { return 1.5 * std::sin(0.6 * x) + 0.3 * std::cos(0.9 * y); }));
  w.add(ground, 0, btVector3(0, 0, 0));
  const auto rock = treeShape(plainTree(cuboid({0.6, 0.5, 0.4}, 3)));
  for (int i = 0; i < 40; ++i) {
    const double x = -80 + i % 4 * 5, y = -20 + i / 4 * 4;
    btRigidBody& body = w.add(rock, 1, btVector3(btScalar(x), btScalar(y), btScalar(*ground->heightAt(x, y) + 1)));
    body.setCcdMotionThreshold(btScalar(0.1));
    body.setLinearVelocity(btVector3(25, 0, 0));
  }
  EXPECT_TRUE(w.dispatcher.setBudget({2000, {}}).ok());
  btScalar deepest = 0;
  for (int step = 0; step < 200; ++step) {
    w.step(1);
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
      for (int k = 0; k < m.getNumContacts(); ++k) deepest = std::min(deepest, m.getContactPoint(k).getDistance());
    }
  }
  // A body that moves 0.4 m in a step into a slope of 45 degrees is 0.3 m deep at most.
  EXPECT_GT(deepest, btScalar(-0.4));
  std::printf("at most %.2f m deep\n", double(-deepest));
}

// A landing body has moved since it was certainly apart. The reported error bounds its depth.
TYPED_TEST(BudgetOnTerrain, TheReportedErrorBoundsWhatLands) {
  BulletWorld<TypeParam> w;
  const auto ground = flatTerrain(bullet::TerrainDiagonals::alternating, {40, 40, 1});
  w.add(ground, 0, btVector3(0, 0, 0));
  const auto ball = treeShape(plainTree(test::ball(0.25, 8)));
  const btScalar size = ball->size();
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < 12; ++i) {
    bodies.push_back(&w.add(ball, 1, btVector3(btScalar(-12 + 2 * i), 0, btScalar(0.9))));
    bodies.back()->setLinearVelocity(btVector3(0, 0, -10));
  }
  EXPECT_TRUE(w.dispatcher.setBudget({1, {}}).ok());
  double depth = 0;
  while (depth <= 0) {
    w.step(1);
    depth = (0.25 - double(bodies[0]->getWorldTransform().getOrigin().z())) / double(size);
    ASSERT_GT(depth, -2) << "it flies away";
  }
  EXPECT_GT(depth, 0.03) << "nothing sank: the test shows nothing";
  // At these poses twice, each time for one of them an answer of its own.
  for (int looks = 1; looks <= 2; ++looks) {
    w.world.performDiscreteCollisionDetection();
    const bullet::StepStatistics& step = w.dispatcher.lastStep();
    const auto all = double(bodies.size());
    EXPECT_GE((all * step.meanErrorFraction - looks * step.worstErrorFraction) / (all - looks), depth) << looks;
  }
}

// Over a static plane likewise; of a ball that reaches into it something is said.
TEST(CoarseGround, SaysNothingThatIsNotTrueOverAPlane) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  TreeOverTerrain s(kSeed);
  btStaticPlaneShape plane(btVector3(1, -2, 5).normalized(), btScalar(0.3));
  s.groundBody.setCollisionShape(&plane);
  constexpr btScalar kReach = btScalar(0.05);
  int contacts = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    s.place();
    CoarseGround coarse(s.wrapper(s.body), s.wrapper(s.groundBody), kReach);
    const btVector3 normal = s.groundBody.getWorldTransform().getBasis() * plane.getPlaneNormal();
    for (const bullet::Contact& contact : coarse.contacts()) {
      ++contacts;
      const btVector3 point = s.inGround(contact);
      EXPECT_LT(s.fromNearestVertex(point), kRounding);
      EXPECT_LT((normal - btVector3(contact.normal.x, contact.normal.y, contact.normal.z)).length(), kRounding);
      EXPECT_NEAR(contact.separation, point.dot(plane.getPlaneNormal()) - plane.getPlaneConstant(), kRounding);
      EXPECT_EQ(contact.id.otherPart, -1);
    }
    const btVector3 middle = s.groundBody.getWorldTransform().inverse() * s.body.getWorldTransform().getOrigin();
    if (middle.dot(plane.getPlaneNormal()) < plane.getPlaneConstant()) {
      EXPECT_FALSE(coarse.contacts().empty());
    }
  }
  EXPECT_GT(contacts, kTrials);
}

}  // namespace
}  // namespace cairn::test::coarse_ground_test
