// SPDX-License-Identifier: Zlib
// Against v = v0 exp(-c t / m), which stops after m v0 / c.
#include "cairn/effects/forest_drag.h"

#include <cmath>

#include "effect_world.h"

namespace cairn::test::forest_drag_test {
namespace {

using effects::ForestDrag;
using effects::LevelGround;

constexpr btScalar kStep = btScalar(1) / 240, kMass = 500, kSpeed = 20, kCoefficient = 250;

/// A rock in the air, weightless.
struct Flight : EffectWorld {
  Flight() { bullet.world.setGravity(btVector3(0, 0, 0)); }
  btRigidBody& rock(btScalar x, btScalar z) {
    return ball(btScalar(0.3), kMass, btVector3(x, 0, z), btVector3(0, kSpeed, 0));
  }
  LevelGround ground{100};
};

TEST(ForestDrag, SpeedDiesAwayAsTheLawSays) {
  Flight w;
  btRigidBody& rock = w.rock(0, 103);
  w.effect<ForestDrag>(ForestDrag::Options{.height = 5, .coefficient = kCoefficient}, w.ground);
  for (int second = 1; second <= 5; ++second) {
    w.step(240, kStep);
    // A rounding a step.
    const double rounding = 240 * second * double(SIMD_EPSILON), exponent = double(kCoefficient * second / kMass);
    EXPECT_NEAR(double(rock.getLinearVelocity().y()) / (double(kSpeed) * std::exp(-exponent)), 1, rounding);
  }
}

TEST(ForestDrag, ARockStopsWhereTheLawSays) {
  Flight w;
  btRigidBody& rock = w.rock(0, 103);
  w.effect<ForestDrag>(ForestDrag::Options{.height = 5, .coefficient = kCoefficient}, w.ground);
  w.step(240 * 60, kStep);
  // A step's way is that of its last speed: half a step's way less than the integral, all told.
  EXPECT_NEAR(rock.getWorldTransform().getOrigin().y(), kMass * kSpeed / kCoefficient, kSpeed * kStep);
  EXPECT_GE(rock.getLinearVelocity().y(), 0);
}

/// Ground for x < 10 only.
class Shelf final : public effects::GroundHeight {
 public:
  std::optional<btScalar> at(btScalar x, btScalar) const override {
    return x < 10 ? std::optional<btScalar>(100) : std::nullopt;
  }
};

TEST(ForestDrag, ActsBelowItsHeightOverGroundInItsRegion) {
  Flight w;
  const Shelf shelf;
  btRigidBody& low = w.rock(1, btScalar(104.9));
  btRigidBody& high = w.rock(3, btScalar(105.1));
  btRigidBody& beside = w.rock(7, 102);
  btRigidBody& off = w.rock(12, 102);
  w.effect<ForestDrag>(
      ForestDrag::Options{
          .height = 5, .coefficient = kCoefficient, .region = effects::Region({{0, -9}, {5, -9}, {5, 9}, {0, 9}})},
      shelf);
  w.step(1, kStep);
  EXPECT_LT(low.getLinearVelocity().y(), kSpeed);
  EXPECT_EQ(high.getLinearVelocity().y(), kSpeed);
  EXPECT_EQ(beside.getLinearVelocity().y(), kSpeed);
  EXPECT_EQ(off.getLinearVelocity().y(), kSpeed);
  EXPECT_EQ(w.acted(), 1U);
}

}  // namespace
}  // namespace cairn::test::forest_drag_test
