// SPDX-License-Identifier: Zlib
#include "pairs/body_motion.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <LinearMath/btTransformUtil.h>
#include <gtest/gtest.h>

#include <random>

#include "bullet_world.h"
#include "contacts/relative_placement.h"
#include "random_tree.h"

namespace cairn::test::body_motion_test {
namespace {

constexpr unsigned kSeed = 12;
constexpr btScalar kTimeStep = btScalar(1e-3);
constexpr btScalar kRadius = btScalar(0.1);
// Speeds change within a step by the step times the turning; places are rounded by some units in the last place.
constexpr btScalar kSecondOrder = btScalar(0.01), kRounding = btScalar(5e-5);

btVector3 randomVector(std::mt19937_64& engine, double size) {
  const Vec3d p = randomPoint(engine) * size;
  return {btScalar(p.x), btScalar(p.y), btScalar(p.z)};
}

btTransform moved(const btRigidBody& body) {
  btTransform after;
  btTransformUtil::integrateTransform(body.getWorldTransform(), body.getLinearVelocity(), body.getAngularVelocity(),
                                      kTimeStep, after);
  return after;
}

// How far a ball about the first body's origin moves in the second's frame in a step.
btScalar wayInFrameOf(const btRigidBody& second, const btRigidBody& first) {
  const auto placement = [](const btTransform& tree, const btTransform& other) {
    bullet::RelativePlacement p;
    p.treeInOther = other.inverseTimes(tree);
    p.center = btVector3(0, 0, 0);
    p.radius = kRadius;
    return p;
  };
  return placement(moved(first), moved(second))
      .displacementSince(placement(first.getWorldTransform(), second.getWorldTransform()));
}

struct TwoBodies {
  BulletWorld<> w;
  btRigidBody& first = w.add(std::make_shared<btSphereShape>(kRadius), 1, btVector3(0, 0, 0));
  btRigidBody& second = w.add(std::make_shared<btSphereShape>(kRadius), 1, btVector3(5, 0, 0));
};

TEST(BodyMotion, NothingMovesFasterInATurningFrameThanIsSaid) {
  std::mt19937_64 engine(kSeed);
  for (int trial = 0; trial < 200; ++trial) {
    TwoBodies b;
    for (btRigidBody* body : {&b.first, &b.second}) {
      body->getWorldTransform().setOrigin(randomVector(engine, 3));
      body->setLinearVelocity(randomVector(engine, 5));
      body->setAngularVelocity(randomVector(engine, 5));
    }
    const btScalar bound = btScalar(bullet::speedInFrameOf(b.second, b.first, float(kRadius))) * kTimeStep;
    EXPECT_LE(wayInFrameOf(b.second, b.first), bound * (1 + kSecondOrder) + kRounding)
        << "seed " << kSeed << ", trial " << trial;
  }
}

TEST(BodyMotion, WhatRestsBesideATurningBodyMovesInItsFrame) {
  TwoBodies b;
  b.second.setAngularVelocity(btVector3(0, 0, 2));
  EXPECT_NEAR(bullet::speedInFrameOf(b.second, b.first, float(kRadius)), 2 * 5.1, 1e-5);
  EXPECT_GT(wayInFrameOf(b.second, b.first), 10 * bullet::closingSpeed(b.second, b.first, float(kRadius)) * kTimeStep);
  b.first.setAngularVelocity(btVector3(0, 0, 2));
  b.first.setLinearVelocity(btVector3(0, -10, 0));
  EXPECT_NEAR(bullet::speedInFrameOf(b.second, b.first, float(kRadius)), 0, 1e-5) << "carried along";
}

}  // namespace
}  // namespace cairn::test::body_motion_test
