// SPDX-License-Identifier: Zlib
// A blow acts where bodies touch first, however far they move in a step.
#include <gtest/gtest.h>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <memory>

#include "cairn/effects/friction.h"
#include "effect_world.h"
#include "slope_world.h"

namespace cairn::test::blow_order_test {
namespace {

constexpr btScalar kBall = btScalar(0.05), kHalf = btScalar(0.5), kSunk = btScalar(0.08), kMass = 100;

/// What two balls, joined by a rod that leans, get of the ground in a step in which they are found sunk into it.
struct Blow {
  btScalar low = 0, high = 0;            // N s
  btScalar lowDepth = 0, highDepth = 0;  // m, as told when the step is over
};

Blow blowOf(btScalar higherBy, btScalar friction, btScalar fall) {
  SlopeWorld world(0, 200);
  world.add<effects::Friction>(effects::PairTable<btScalar>(friction));
  btSphereShape ball(kBall);
  const auto rod = std::make_shared<btCompoundShape>();
  for (const btScalar end : {-kHalf, kHalf})
    rod->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(end, 0, 0)), &ball);
  const btVector3 middle(0, 0, kBall - kSunk + higherBy / 2);
  btRigidBody& body = world.addBody(rod, kMass, middle, ballVolume(btScalar(0.3)));
  body.setWorldTransform(btTransform(btQuaternion(btVector3(0, -1, 0), btAsin(higherBy / (2 * kHalf))), middle));
  body.setLinearVelocity(btVector3(0, 0, -fall));
  world.runStep();
  Blow blow;
  for (int i = 0; i < world.bullet.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *world.bullet.dispatcher.getManifoldByIndexInternal(i);
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold.getContactPoint(p);
      const bool isLow = point.getPositionWorldOnB().x() < 0;
      (isLow ? blow.low : blow.high) += point.getAppliedImpulse();
      (isLow ? blow.lowDepth : blow.highDepth) = -point.getDistance();
    }
  }
  return blow;
}

TEST(Blow, ActsOnWhatTouchesFirst) {
  constexpr btScalar kHigher = btScalar(0.04);
  const Blow blow = blowOf(kHigher, btScalar(0.5), 20);
  EXPECT_GT(blow.low, kMass);
  EXPECT_EQ(blow.high, 0) << "it touches 2 ms later, and the rod turns meanwhile";
  EXPECT_NEAR(blow.lowDepth, kSunk, 1e-3) << "what is told of contacts is what it was";
  EXPECT_NEAR(blow.highDepth, kSunk - kHigher, 1e-3);
}

TEST(Blow, ActsOnAllThatTouchesTogether) {
  const Blow blow = blowOf(btScalar(0.01), btScalar(0.5), 20);
  EXPECT_GT(blow.low, kMass);
  EXPECT_GT(blow.high, kMass);
}

// What rests is held wherever it lies, and without friction the order changes nothing that matters.
TEST(Blow, IsLeftAloneWhereNobodyAsksOrItIsNone) {
  EXPECT_GT(blowOf(btScalar(0.04), btScalar(0.5), 0).high, 0);
  EXPECT_GT(blowOf(btScalar(0.04), 0, 20).high, 0);
}

}  // namespace
}  // namespace cairn::test::blow_order_test
