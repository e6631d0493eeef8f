// SPDX-License-Identifier: Zlib
// Friction by pair of materials, against the textbook.
#include "cairn/effects/friction.h"

#include <gtest/gtest.h>

#include "slope_world.h"

namespace cairn::test::friction_test {
namespace {

using effects::Friction;
using effects::PairTable;

// Thin, so that friction turns it little and its points share the load.
constexpr btScalar kHalf = btScalar(0.5), kThin = btScalar(0.05);

PairTable<btScalar> onlyRockOnSoil(btScalar friction) {
  PairTable<btScalar> table(btScalar(9));
  table.set(kSoil, kRock, friction);
  return table;
}

struct Slide {
  btScalar way, speed;  // along the slope
};

/// A box laid on a slope, let go with a speed along it.
Slide slideOf(btScalar slope, btScalar friction, btScalar speed, btScalar seconds) {
  SlopeWorld world(slope);
  world.add<Friction>(onlyRockOnSoil(friction));
  const btVector3 up(btSin(slope), 0, btCos(slope)), along(btCos(slope), 0, -btSin(slope));
  btRigidBody& box = world.addBody(std::make_shared<btBoxShape>(btVector3(kHalf, kHalf, kThin)), 10, up * kThin);
  box.setWorldTransform(btTransform(btQuaternion(btVector3(0, 1, 0), slope), up * kThin));
  box.setLinearVelocity(along * speed);
  const btVector3 start = box.getWorldTransform().getOrigin();
  world.run(seconds);
  return {(box.getWorldTransform().getOrigin() - start).dot(along), box.getLinearVelocity().dot(along)};
}

// Relative, for a box of four points at 240 Hz: the solver's friction is a pyramid and settles in the first steps.
constexpr btScalar kTolerance = btScalar(0.02);

TEST(Friction, SlidesAtTheTextbooksAcceleration) {
  const btScalar expected = kGravity * (btSin(radians(30)) - btScalar(0.3) * btCos(radians(30)));
  // In the first second it also settles.
  const btScalar gained =
      slideOf(radians(30), btScalar(0.3), 0, 2).speed - slideOf(radians(30), btScalar(0.3), 0, 1).speed;
  EXPECT_NEAR(gained, expected, kTolerance * expected);
}

TEST(Friction, SticksAboveTheSlopesTangentAndSlipsBelow) {
  const btScalar slope = btAtan(btScalar(0.5));
  EXPECT_LT(slideOf(slope, btScalar(0.55), 0, 5).way, 0.01);
  const btScalar exact = kGravity * (btSin(slope) - btScalar(0.45) * btCos(slope)) * 25 / 2;
  EXPECT_GT(slideOf(slope, btScalar(0.45), 0, 5).way, btScalar(0.8) * exact);
}

TEST(Friction, StopsAfterTheTextbooksWay) {
  constexpr btScalar kSpeed = 5, kFriction = btScalar(0.4);
  const btScalar expected = kSpeed * kSpeed / (2 * kFriction * kGravity);
  EXPECT_NEAR(slideOf(0, kFriction, kSpeed, 3).way, expected, kTolerance * expected);
}

TEST(Friction, OfAPairIsTheSameEitherWayRoundAndOthersTakeTheDefault) {
  PairTable<btScalar> table(btScalar(0.7));
  table.set(kIce, kRock, btScalar(0.1));
  EXPECT_EQ(table.at(kRock, kIce), btScalar(0.1));
  EXPECT_EQ(table.at(kIce, kRock), btScalar(0.1));
  EXPECT_EQ(table.at(kRock, kRock), btScalar(0.7));
  EXPECT_EQ(table.at(kSoil, kIce), btScalar(0.7));
  EXPECT_EQ(table.at(99, kRock), btScalar(0.7));
}

}  // namespace
}  // namespace cairn::test::friction_test
