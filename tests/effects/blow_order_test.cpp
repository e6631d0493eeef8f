// SPDX-License-Identifier: Zlib
// A blow acts where bodies touch first, however far they move in a step.
#include <gtest/gtest.h>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <memory>

#include "cairn/effects/friction.h"
#include "cairn/effects/tangential_restitution.h"
#include "effect_world.h"
#include "slope_world.h"

namespace cairn::test::blow_order_test {
namespace {

constexpr btScalar kBall = btScalar(0.05), kHalf = btScalar(0.5), kSunk = btScalar(0.08), kMass = 100;
constexpr btScalar kRadius = btScalar(0.3), kStepsPerSecond = 200;

/// The impulses that two balls, joined by a rod that leans, get from the ground in a step in which they are found sunk
/// into it.
struct Blow {
  btScalar low = 0, high = 0;            // N s
  btScalar lowDepth = 0, highDepth = 0;  // m, as told when the step is over
};

struct Fall {
  btScalar higherBy = btScalar(0.04), friction = btScalar(0.5), speed = 20;
  btScalar spin = 0;          // rad/s, lifts the low end
  btScalar bounceLeaves = 1;  // of the speed along the ground
  btScalar sunk = kSunk;      // of the low end; negative: ahead
};

btRigidBody& addRod(SlopeWorld& world) {
  static btSphereShape ball(kBall);  // compounds own no children
  const auto rod = std::make_shared<btCompoundShape>();
  for (const btScalar end : {-kHalf, kHalf})
    rod->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(end, 0, 0)), &ball);
  return world.addBody(rod, kMass, btVector3(0, 0, 100), ballVolume(kRadius));
}

void place(btRigidBody& rod, const Fall& fall) {
  const btVector3 middle(0, 0, kBall - fall.sunk + fall.higherBy / 2);
  rod.setWorldTransform(btTransform(btQuaternion(btVector3(0, -1, 0), btAsin(fall.higherBy / (2 * kHalf))), middle));
  rod.setLinearVelocity(btVector3(0, 0, -fall.speed));
  rod.setAngularVelocity(btVector3(0, fall.spin, 0));
}

Blow blowOf(const Fall& fall) {
  SlopeWorld world(0, kStepsPerSecond);
  world.add<effects::Friction>(effects::PairTable<btScalar>(fall.friction));
  world.add<effects::TangentialRestitution>(effects::PairTable<btScalar>(fall.bounceLeaves));
  btRigidBody& rod = addRod(world);
  world.run(btScalar(0.3));  // a free flight, after which a blow is a bounce
  place(rod, fall);
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
  const Blow blow = blowOf({});
  EXPECT_GT(blow.low, kMass);
  EXPECT_EQ(blow.high, 0) << "it touches 2 ms later, and the rod turns meanwhile";
  EXPECT_NEAR(blow.lowDepth, kSunk, 1e-3) << "what is told of contacts is what it was";
  EXPECT_NEAR(blow.highDepth, kSunk - Fall().higherBy, 1e-3);
}

TEST(Blow, ActsOnAllThatTouchesTogether) {
  const Blow blow = blowOf({.higherBy = btScalar(0.01)});
  EXPECT_GT(blow.low, kMass);
  EXPECT_GT(blow.high, kMass);
}

// A body at rest is held wherever it lies, and without friction the order changes nothing that matters.
TEST(Blow, IsLeftAloneWhereNobodyAsksOrItIsNone) {
  constexpr auto kSlow = btScalar(0.15);
  static_assert(kSlow < effects::EffectSet::kImpactSpeed);
  EXPECT_GT(blowOf({.speed = kSlow}).high, 0);
  EXPECT_GT(blowOf({.friction = 0}).high, 0);
}

// At 1 m/s the low end would have touched 80 ms ago, the high end, at 20 m/s, 2 ms ago.
TEST(Blow, CountsNoCornerAsFirstThatIsSlowBesideTheFastest) {
  const Blow blow = blowOf({.speed = btScalar(10.5), .spin = 19});
  EXPECT_GT(blow.high, kMass);
  EXPECT_GT(blow.low, 0) << "it is held all the same";
}

// Its bounce has no friction, so nothing that the order of its corners would save.
TEST(Blow, IsLeftAloneInABounceWithoutFriction) {
  EXPECT_EQ(blowOf({.bounceLeaves = 1}).high, 0);
  EXPECT_GT(blowOf({.bounceLeaves = btScalar(0.5)}).high, 0);
}

// Of an end that has no say in a step nothing is left that it bore in the step before.
TEST(Blow, LeavesNoImpulseOfAnEarlierStep) {
  SlopeWorld world(0, kStepsPerSecond);
  world.add<effects::Friction>(effects::PairTable<btScalar>(btScalar(0.5)));
  btRigidBody& rod = addRod(world);
  place(rod, {.friction = 0, .speed = btScalar(0.15)});
  world.runStep();
  place(rod, {});
  world.runStep();
  int later = 0;
  for (int i = 0; i < world.bullet.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *world.bullet.dispatcher.getManifoldByIndexInternal(i);
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      if (manifold.getContactPoint(p).getPositionWorldOnB().x() < 0) continue;
      EXPECT_EQ(manifold.getContactPoint(p).getAppliedImpulse(), 0);
      ++later;
    }
  }
  EXPECT_EQ(later, 1);
}

// An end that comes down upright at 4 m/s, 15 mm ahead, on a rod that spins so fast that it goes up again before it
// touches. It keeps the 3 m/s that bring it to the ground in the step: a blow would take all four.
TEST(Blow, DoesNotActAheadOnWhatWillNotClose) {
  constexpr btScalar kAhead = btScalar(0.015), kClosing = 4;
  const Blow blow = blowOf({.higherBy = 2 * kHalf * btScalar(0.9992), .speed = 0, .spin = -200, .sunk = -kAhead});
  EXPECT_LT(blow.low, kMass * kClosing / 2);
}

}  // namespace
}  // namespace cairn::test::blow_order_test
