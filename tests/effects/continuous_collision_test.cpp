// SPDX-License-Identifier: Zlib
// Shots at a thin wall: with the effect none goes through, without it some do.
#include "cairn/effects/continuous_collision.h"

#include <random>

#include "effect_world.h"

namespace cairn::test::continuous_collision_test {
namespace {

using effects::ContinuousCollision;

constexpr btScalar kRadius = btScalar(0.3), kStep = btScalar(1) / 60;
constexpr int kShots = 100;

std::shared_ptr<btCollisionShape> shapeOf(bool isTree) {
  static const std::shared_ptr<const SphereTree> tree = plainTree(ball(double(kRadius), 2));
  if (isTree) return treeShape(tree);
  return std::make_shared<btSphereShape>(kRadius);
}

// How many of the shots end behind a wall of 2 cm that is wider than they fly.
int through(bool isTree, bool isOn, std::uint64_t* counted = nullptr) {
  std::mt19937 random(20021);
  std::uniform_real_distribution<double> part(0, 1);
  int passed = 0;
  for (int shot = 0; shot < kShots; ++shot) {
    EffectWorld w;
    w.bullet.world.setGravity(btVector3(0, 0, 0));
    w.bullet.add(std::make_shared<btBoxShape>(btVector3(50, 50, btScalar(0.01))), 0, btVector3(0, 0, 0));
    const btVector3 way(btScalar(part(random)), btScalar(part(random)), btScalar(-1));
    btRigidBody& body = w.bullet.add(shapeOf(isTree), 1, btVector3(0, 0, btScalar(2 + 5 * part(random))));
    body.setLinearVelocity(way * btScalar(10 + 140 * part(random)));
    w.join(body, ballVolume(kRadius));
    if (isOn) w.effect<ContinuousCollision>(ContinuousCollision::Options{});
    w.step(40, kStep);
    passed += body.getWorldTransform().getOrigin().z() < 0 ? 1 : 0;
    if (isOn && counted) *counted += w.acted();
  }
  return passed;
}

TEST(ContinuousCollision, NoBallGoesThroughAThinWall) {
  std::uint64_t counted = 0;
  EXPECT_EQ(through(false, true, &counted), 0);
  EXPECT_GE(counted, std::uint64_t(kShots)) << "all were fast for a step or more";
  EXPECT_GT(through(false, false), kShots / 4);
}

TEST(ContinuousCollision, NorDoesASphereTree) {
  EXPECT_EQ(through(true, true), 0);
  EXPECT_GT(through(true, false), kShots / 4);
}

TEST(ContinuousCollision, KnowsHowThickAShapeIs) {
  EXPECT_EQ(ContinuousCollision::innerRadius(btSphereShape(2)), 2);
  EXPECT_NEAR(ContinuousCollision::innerRadius(btBoxShape(btVector3(1, btScalar(0.25), 3))), 0.25, 1e-6);
  const Solid bar = cuboid({3, 1, 1}, 4);
  const auto unknown = treeShape(plainTree(bar), 2);  // its tree says nothing of what is inside
  const btScalar around = unknown->size() * bullet::kSpeculativeFraction * 2;
  EXPECT_NEAR(ContinuousCollision::innerRadius(*unknown), 1, around);
  SphereTreeData data = PlainTreeBuilder(bar, 2).build();
  data.nodes[0].innerRadius = 0.5F;
  data.nodes[1].innerRadius = 0.125F;
  const auto known = treeShape(std::make_shared<const SphereTree>(SphereTree::create(std::move(data)).value()), 2);
  EXPECT_EQ(ContinuousCollision::innerRadius(*known), 1);
}

TEST(ContinuousCollision, GivesBackWhatItSet) {
  EffectWorld w;
  btRigidBody& body = w.ball(kRadius, 1, btVector3(0, 0, 0), btVector3(0, 0, 0));
  body.setCcdMotionThreshold(7);
  body.setCcdSweptSphereRadius(btScalar(0.125));
  w.effect<ContinuousCollision>(ContinuousCollision::Options{.radiiPerStep = btScalar(0.5)});
  EXPECT_EQ(body.getCcdMotionThreshold(), kRadius / 2);
  w.set->removeBody(body);
  EXPECT_EQ(body.getCcdMotionThreshold(), 7);
  EXPECT_EQ(body.getCcdSweptSphereRadius(), btScalar(0.125));
}

}  // namespace
}  // namespace cairn::test::continuous_collision_test
