// SPDX-License-Identifier: Zlib
// A net takes what it can, once a meeting, and holds what has no more.
#include "cairn/effects/barrier.h"

#include <cmath>

#include "effect_world.h"

namespace cairn::test::barrier_test {
namespace {

using effects::Barrier;
using effects::LevelGround;
using Segments = std::vector<Barrier::Segment>;

constexpr btScalar kStep = btScalar(1) / 120, kRadius = btScalar(0.4), kMass = 1000, kSpeed = 20;
constexpr btScalar kEnergy = kMass * kSpeed * kSpeed / 2;
// Of a square root and a quotient, and of adding up.
constexpr btScalar kRounding = 100 * SIMD_EPSILON;
const Segments kAcross{{{0, -10}, {0, 10}}};

/// A rock flies along x, without weight, from 5 m before a net across its way, 2 m above level ground.
struct Slope : EffectWorld {
  explicit Slope(btScalar gravity = 0) { bullet.world.setGravity(btVector3(0, 0, -gravity)); }
  Barrier& net(Segments segments, btScalar capacity, btScalar height = 4) {
    return effect<Barrier>(std::move(segments), ground, Barrier::Options{height, capacity});
  }
  btRigidBody& rock(btScalar y = 0, btScalar speed = kSpeed) {
    return ball(kRadius, kMass, btVector3(-5, y, 2), btVector3(speed, 0, 0));
  }
  LevelGround ground{0};
};

TEST(Barrier, TakesItsCapacityAndLeavesTheRest) {
  Slope s;
  s.net(kAcross, kEnergy / 4);
  btRigidBody& rock = s.rock();
  rock.setAngularVelocity(btVector3(1, 2, 3));
  const btScalar before = kineticEnergy(rock);
  s.step(120, kStep);
  EXPECT_NEAR(kineticEnergy(rock) / (before - kEnergy / 4), 1, kRounding);
  EXPECT_NEAR(rock.getAngularVelocity().y() / rock.getAngularVelocity().x(), 2, kRounding) << "in its direction";
  EXPECT_EQ(s.acted(), 1U) << "once, though the ball needs many steps to pass";
}

TEST(Barrier, HoldsWhatItCanTakeAgainstItsWeight) {
  Slope s(btScalar(9.81));
  s.net(kAcross, 2 * kEnergy);
  btRigidBody& rock = s.rock();
  s.step(60, kStep);
  const btVector3 caught = rock.getCenterOfMassPosition();
  EXPECT_LE(caught.x(), -kRadius + kSpeed * kStep);
  EXPECT_GE(caught.x(), -kRadius - kSpeed * kStep);
  s.step(1200, kStep);
  EXPECT_EQ(rock.getCenterOfMassPosition(), caught) << "it hangs in the net";
  EXPECT_EQ(rock.getLinearVelocity(), btVector3(0, 0, 0));
  EXPECT_EQ(s.acted(), 1U);
}

TEST(Barrier, IsAWallForWhatMeetsACaughtRock) {
  Slope s;
  s.net(kAcross, 2 * kEnergy);
  btRigidBody& first = s.rock();
  s.step(60, kStep);
  const btVector3 caught = first.getCenterOfMassPosition();
  btRigidBody& second = s.rock();
  s.step(120, kStep);
  EXPECT_EQ(first.getCenterOfMassPosition(), caught);
  EXPECT_LT(second.getCenterOfMassPosition().x(), caught.x() - kRadius);
}

TEST(Barrier, ActsNeitherAboveNorBesideNorAwayFromIt) {
  struct Miss {
    const char* what;
    btScalar y, height, speed;
  };
  for (const Miss& miss : {Miss{"over it", 0, btScalar(1.9), kSpeed}, Miss{"beside its end", btScalar(10.1), 4, kSpeed},
                           Miss{"away from it", 0, 4, -kSpeed}}) {
    Slope s;
    s.net(kAcross, 2 * kEnergy, miss.height);
    const btRigidBody& rock = s.rock(miss.y, miss.speed);
    s.step(120, kStep);
    EXPECT_EQ(s.acted(), 0U) << miss.what;
    EXPECT_EQ(rock.getLinearVelocity().x(), miss.speed) << miss.what;
  }
}

TEST(Barrier, MeetsFromBothSidesAndAtACornerOnce) {
  Slope s;
  s.net({{{0, -10}, {0, 0}}, {{0, 0}, {1, 10}}, {{3, 3}, {3, 3}}}, kEnergy / 10);
  btRigidBody& rock = s.rock();
  s.step(120, kStep);
  EXPECT_EQ(s.acted(), 1U) << "two segments of one net";
  rock.setLinearVelocity(-rock.getLinearVelocity());
  s.step(240, kStep);
  EXPECT_EQ(s.acted(), 2U) << "back again";
}

TEST(Barrier, CatchesAtAnySpeedAndStep) {
  for (const btScalar step : {btScalar(1) / 30, btScalar(1) / 240, btScalar(1) / 1000})
    for (const btScalar speed : {btScalar(0.5), btScalar(7), btScalar(60)}) {
      Slope s;
      s.net(kAcross, kMass * speed * speed);
      const btRigidBody& rock = s.rock(0, speed);
      s.step(static_cast<int>(20 / speed / step), step);
      EXPECT_EQ(rock.getLinearVelocity(), btVector3(0, 0, 0)) << step << " s, " << speed << " m/s";
      EXPECT_LT(rock.getCenterOfMassPosition().x(), 0) << step << " s, " << speed << " m/s";
    }
}

}  // namespace
}  // namespace cairn::test::barrier_test
