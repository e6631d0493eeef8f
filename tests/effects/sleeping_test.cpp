// SPDX-License-Identifier: Zlib
// Who falls asleep, when, and that it is left as it was found.
#include "cairn/effects/sleeping.h"

#include "effect_world.h"

namespace cairn::test::sleeping_test {
namespace {

using effects::Sleeping;

constexpr btScalar kStep = btScalar(1) / 128;  // adds up without rounding

int stepsUntilAsleep(EffectWorld& w, const btRigidBody& body, int most) {
  for (int i = 1; i <= most; ++i) {
    w.step(1, kStep);
    if (!body.isActive()) return i;
  }
  return 0;
}

TEST(Sleeping, WhatLiesStillSleepsWhenItsTimeIsUp) {
  const btScalar bulletsTime = gDeactivationTime;
  for (const btScalar after : {btScalar(0.5), btScalar(2), btScalar(5)}) {
    EffectWorld w;
    w.bullet.world.setGravity(btVector3(0, 0, 0));
    btRigidBody& body = w.ball(1, 1, btVector3(0, 0, 0), btVector3(0, 0, 0));
    w.effect<Sleeping>(Sleeping::Options{.after = after});
    // Bullet wants the time to be over, and puts a body to sleep in the step after.
    EXPECT_NEAR(stepsUntilAsleep(w, body, 2000), after / kStep + 1, 1);
    w.step(1, kStep);
    EXPECT_GE(w.acted(), 1U) << "counts who sleeps";
  }
  EXPECT_EQ(gDeactivationTime, bulletsTime) << "other worlds' time is theirs";
}

TEST(Sleeping, AHeapSleepsAndABlowWakesIt) {
  EffectWorld w;
  w.ground(0);
  btRigidBody& low = w.ball(btScalar(0.5), 1, btVector3(0, 0, btScalar(0.5)), btVector3(0, 0, 0));
  w.effect<Sleeping>(Sleeping::Options{.after = 1});
  ASSERT_GT(stepsUntilAsleep(w, low, 1000), 0);
  btRigidBody& stone = w.ball(btScalar(0.2), 1, btVector3(btScalar(0.1), 0, 3), btVector3(0, 0, -3));
  bool wasWoken = false;
  for (int i = 0; i < 200; ++i) {
    w.step(1, kStep);
    wasWoken = wasWoken || low.isActive();
  }
  EXPECT_TRUE(wasWoken);
  EXPECT_TRUE(stone.isActive() || wasWoken);
}

TEST(Sleeping, WhatMovesFasterThanEitherThresholdStaysAwake) {
  EffectWorld w;
  w.bullet.world.setGravity(btVector3(0, 0, 0));
  btRigidBody& moving = w.ball(1, 1, btVector3(0, 0, 0), btVector3(btScalar(0.02), 0, 0));
  btRigidBody& turning = w.ball(1, 1, btVector3(0, 9, 0), btVector3(0, 0, 0));
  turning.setAngularVelocity(btVector3(0, 0, btScalar(0.02)));
  btRigidBody& slow = w.ball(1, 1, btVector3(0, 18, 0), btVector3(btScalar(0.005), 0, 0));
  w.effect<Sleeping>(Sleeping::Options{.linear = btScalar(0.01), .angular = btScalar(0.01), .after = 1});
  EXPECT_GT(stepsUntilAsleep(w, slow, 400), 0);
  EXPECT_TRUE(moving.isActive());
  EXPECT_TRUE(turning.isActive());
}

TEST(Sleeping, LeavesABodyAsItCame) {
  EffectWorld w;
  btRigidBody& body = w.ball(1, 1, btVector3(0, 0, 0), btVector3(0, 0, 0));
  body.setSleepingThresholds(btScalar(0.25), btScalar(0.5));
  ASSERT_EQ(body.getActivationState(), DISABLE_DEACTIVATION);
  w.effect<Sleeping>(Sleeping::Options{.linear = 3, .angular = 4});
  EXPECT_EQ(body.getActivationState(), ACTIVE_TAG);
  EXPECT_EQ(body.getLinearSleepingThreshold(), 3);
  w.set->removeBody(body);
  EXPECT_EQ(body.getActivationState(), DISABLE_DEACTIVATION);
  EXPECT_EQ(body.getLinearSleepingThreshold(), btScalar(0.25));
  EXPECT_EQ(body.getAngularSleepingThreshold(), btScalar(0.5));
}

}  // namespace
}  // namespace cairn::test::sleeping_test
