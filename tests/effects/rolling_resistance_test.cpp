// SPDX-License-Identifier: Zlib
// Resistance to rolling and spinning, against the textbook.
#include "cairn/effects/rolling_resistance.h"

#include <gtest/gtest.h>

#include "cairn/effects/friction.h"
#include "slope_world.h"

namespace cairn::test::rolling_resistance_test {
namespace {

using effects::RollingResistance;

constexpr btScalar kRadius = btScalar(0.5), kMass = 10;

struct Rolling {
  SlopeWorld world;
  btRigidBody* ball = nullptr;

  explicit Rolling(const RollingResistance::Lengths& lengths) {
    world.add<effects::Friction>(effects::PairTable<btScalar>(btScalar(0.8)));
    world.add<RollingResistance>(effects::PairTable<RollingResistance::Lengths>(lengths));
    ball = &world.addBody(std::make_shared<btSphereShape>(kRadius), kMass, btVector3(0, 0, kRadius));
  }
};

btScalar wayOf(btScalar length, btScalar speed) {
  Rolling rolling({.rolling = length});
  rolling.ball->setLinearVelocity(btVector3(speed, 0, 0));
  rolling.ball->setAngularVelocity(btVector3(0, speed / kRadius, 0));
  rolling.world.run(10);
  EXPECT_LT(rolling.ball->getLinearVelocity().length(), 1e-2) << "rests by now";
  return rolling.ball->getWorldTransform().getOrigin().x();
}

TEST(RollingResistance, ABallStopsAfterTheTextbooksWay) {
  constexpr btScalar kLength = btScalar(0.05), kSpeed = 2;
  const btScalar deceleration = btScalar(5) / 7 * kGravity * kLength / kRadius;
  const btScalar expected = kSpeed * kSpeed / (2 * deceleration);
  EXPECT_NEAR(wayOf(kLength, kSpeed), expected, btScalar(0.02) * expected);
}

TEST(RollingResistance, LongerArmShorterWay) {
  EXPECT_LT(wayOf(btScalar(0.1), 2), btScalar(0.6) * wayOf(btScalar(0.05), 2));
}

TEST(RollingResistance, SpinningOnTheSpotDiesAwayOnlyWithItsOwnLength) {
  const auto spinAfter = [](btScalar length, btScalar seconds) {
    Rolling rolling({.spinning = length});
    rolling.ball->setAngularVelocity(btVector3(0, 0, 10));
    rolling.world.run(seconds);
    return rolling.ball->getAngularVelocity().z();
  };
  // I w' = -length m g with I = 2/5 m r^2.
  constexpr btScalar kLength = btScalar(0.02), kSeconds = 2;
  const btScalar expected = 10 - kSeconds * kLength * kGravity / (btScalar(0.4) * kRadius * kRadius);
  EXPECT_NEAR(spinAfter(kLength, kSeconds), expected, btScalar(0.02) * 10);
  EXPECT_NEAR(spinAfter(0, kSeconds), 10, 1e-3);
}

}  // namespace
}  // namespace cairn::test::rolling_resistance_test
