// SPDX-License-Identifier: Zlib
// Continuous collision of what rolls: it changes nothing on a floor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "bullet_world.h"
#include "test_solids.h"

namespace cairn::test::continuous_rolling_test {
namespace {

constexpr std::uint32_t kSeed = 20026;
// Of the speed: what hulls lose more by being stopped a little before they touch.
constexpr btScalar kMaxLost = btScalar(0.1);
constexpr double kThickness = 0.05, kHalfThickness = kThickness / 2;

// Leaves of several cells and both sides, as the builder makes them of thin plates.
std::shared_ptr<btCollisionShape> plate() {
  static const std::shared_ptr<const SphereTree> tree = plainTree(cuboid({4, 2, kThickness}, 16), 8);
  return treeShape(tree);
}

std::shared_ptr<btCollisionShape> slab() {
  static const std::shared_ptr<const SphereTree> tree = plainTree(cuboid({4, 2, 1}, 16), 4);
  return treeShape(tree);
}

void lookAhead(btRigidBody& body, btScalar threshold) {
  body.setCcdMotionThreshold(threshold);
  body.setCcdSweptSphereRadius(2 * threshold);
}

enum class Roller { ball, cylinder, capsule, manyCorners };

constexpr btScalar kRadius = btScalar(0.2);

std::shared_ptr<btCollisionShape> rollerShape(Roller roller) {
  switch (roller) {
    case Roller::ball:
      return std::make_shared<btSphereShape>(kRadius);
    case Roller::cylinder:
      return std::make_shared<btCylinderShape>(btVector3(kRadius, btScalar(0.05), kRadius));
    case Roller::capsule:
      return std::make_shared<btCapsuleShape>(kRadius, btScalar(0.2));
    case Roller::manyCorners:
      break;
  }
  auto hull = std::make_shared<btConvexHullShape>();
  constexpr int kCorners = 24;
  for (int i = 0; i < 2 * kCorners; ++i) {
    const double angle = 2 * 3.14159265358979 * (i / 2) / kCorners;
    hull->addPoint(btVector3(kRadius * btScalar(std::cos(angle)), i % 2 ? btScalar(0.05) : btScalar(-0.05),
                             kRadius * btScalar(std::sin(angle))));
  }
  return hull;
}

struct Rolling {
  btScalar speed = 0;  // of what it began with, at the end, the mean
  int sunk = 0;        // ended in or below what it rolled on
};

// Along x at 2 to 8 m/s, until the end of the ground or for two thirds of a second.
Rolling roll(Roller roller, const std::shared_ptr<btCollisionShape>& ground, btScalar top, bool looksAhead) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(-1, 1);
  constexpr int kRuns = 30;
  Rolling rolling;
  for (int i = 0; i < kRuns; ++i) {
    BulletWorld<> w;
    w.add(ground, 0, btVector3(0, 0, 0));
    const btScalar x = btScalar(-1.5F + 0.3F * unit(random)), y = btScalar(0.3F * unit(random));
    const btScalar speed = btScalar(5 + 3 * unit(random));
    btRigidBody& body = w.add(rollerShape(roller), 1, btVector3(x, y, top + kRadius));
    body.setLinearVelocity(btVector3(speed, 0, 0));
    body.setAngularVelocity(btVector3(0, speed / kRadius, 0));
    if (looksAhead) lookAhead(body, btScalar(0.02));
    btVector3 at = body.getWorldTransform().getOrigin(), v = body.getLinearVelocity();
    for (int step = 0; step < 40 && at.x() < btScalar(1.8) && std::abs(at.y()) < btScalar(0.9); ++step) {
      v = body.getLinearVelocity();
      w.step();
      at = body.getWorldTransform().getOrigin();
    }
    rolling.speed += v.x() / speed / kRuns;
    rolling.sunk += at.z() < top ? 1 : 0;
  }
  return rolling;
}

// Ghost edges inside the floor, and the arcs that a floor moves on about what rolls, braked to a half and sank one in
// seven.
TEST(ContinuousRolling, IsAsWithoutLookingAhead) {
  const char* const names[] = {"ball", "cylinder", "capsule", "hull of 24 corners"};
  for (const Roller roller : {Roller::ball, Roller::cylinder, Roller::capsule, Roller::manyCorners})
    for (const bool isThin : {true, false}) {
      const auto ground = isThin ? plate() : slab();
      const btScalar top = isThin ? btScalar(kHalfThickness) : btScalar(0.5);
      const Rolling with = roll(roller, ground, top, true), without = roll(roller, ground, top, false);
      std::cout << names[static_cast<int>(roller)] << (isThin ? " on a plate" : " on a slab") << ": keeps "
                << with.speed << " of its speed, " << without.speed << " without\n";
      EXPECT_EQ(with.sunk, 0);
      EXPECT_GT(with.speed, without.speed - kMaxLost);
    }
}

}  // namespace
}  // namespace cairn::test::continuous_rolling_test
