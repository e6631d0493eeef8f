// SPDX-License-Identifier: Zlib
// Friction that grows with the way slipped: its law, and the way of a box it stops.
#include "cairn/effects/slip_friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slope_world.h"

namespace cairn::test::slip_friction_test {
namespace {

using effects::SlipFriction;

constexpr SlipFriction::Options kOptions{
    .least = btScalar(0.2), .most = btScalar(1.5), .kappa = btScalar(0.8), .recovery = 2};

effects::PairTable<bool> rockOnSoil() {
  effects::PairTable<bool> table;
  table.set(kRock, kSoil, true);
  return table;
}

TEST(SlipFriction, GrowsFromLeastTowardsMost) {
  const SlipFriction effect(kOptions, rockOnSoil());
  EXPECT_EQ(effect.coefficientAt(0), kOptions.least);
  for (btScalar slip = 0; slip < 20; slip += btScalar(0.25)) {
    EXPECT_LT(effect.coefficientAt(slip), effect.coefficientAt(slip + btScalar(0.25)));
    EXPECT_LT(effect.coefficientAt(slip), kOptions.most);
  }
  EXPECT_NEAR(effect.coefficientAt(1e5), kOptions.most, 1e-3);
}

// Work of friction over the way s, per m g: the integral of mu(s).
double workOver(double s) {
  const double kappa = kOptions.kappa;
  return kOptions.least * s + 2 / std::numbers::pi * (kOptions.most - kOptions.least) *
                                  (s * std::atan(kappa * s) - std::log1p(kappa * kappa * s * s) / (2 * kappa));
}

double wayThatStops(double speed) {
  double low = 0, high = 100;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (workOver(middle) * double(kGravity) < speed * speed / 2 ? low : high) = middle;
  }
  return low;
}

TEST(SlipFriction, StopsABoxWhereTheIntegralSays) {
  for (const btScalar speed : {btScalar(3), btScalar(8)}) {
    SlopeWorld world;
    world.add<SlipFriction>(kOptions, rockOnSoil());
    btRigidBody& box =
        world.addBody(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.1))), 10, btVector3(0, 0, btScalar(0.1)));
    box.setAngularFactor(0);  // friction would press its front down, and press more
    world.run(1);             // settles
    const btScalar start = box.getWorldTransform().getOrigin().x();
    box.setLinearVelocity(btVector3(speed, 0, 0));
    world.run(5);
    const double expected = wayThatStops(speed);
    EXPECT_NEAR(box.getWorldTransform().getOrigin().x() - start, expected, 0.02 * expected) << speed << " m/s";
  }
}

/// Slip dies away in the air: the second of two slides starts as easily as the first if the flight between was long.
TEST(SlipFriction, RecoversInTheAir) {
  const auto lostInSecondSlide = [](btScalar flightSeconds) {
    SlopeWorld world;
    world.add<SlipFriction>(kOptions, rockOnSoil());
    btRigidBody& box =
        world.addBody(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.1))), 10, btVector3(0, 0, btScalar(0.1)));
    box.setLinearVelocity(btVector3(6, 0, 0));
    world.run(btScalar(0.5));
    box.translate(btVector3(0, 0, 50));
    box.setLinearVelocity(btVector3(0, 0, 0));
    box.setGravity(btVector3(0, 0, 0));
    world.run(flightSeconds);
    box.translate(btVector3(0, 0, -50));
    box.setGravity(btVector3(0, 0, -kGravity));
    box.setLinearVelocity(btVector3(6, 0, 0));
    world.run(btScalar(0.1));
    return 6 - box.getLinearVelocity().x();
  };
  const btScalar atOnce = lostInSecondSlide(btScalar(0.02)), later = lostInSecondSlide(5);
  EXPECT_LT(later, btScalar(0.8) * atOnce);
}

TEST(SlipFriction, OfOtherPairsIsLeftAlone) {
  SlopeWorld world;
  world.add<SlipFriction>(kOptions, effects::PairTable<bool>());
  world.addBody(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.1))), 10, btVector3(0, 0, btScalar(0.1)));
  world.run(1);
  EXPECT_EQ(world.set().report().front().acted, 0U);
}

}  // namespace
}  // namespace cairn::test::slip_friction_test
