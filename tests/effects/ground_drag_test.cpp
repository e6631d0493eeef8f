// SPDX-License-Identifier: Zlib
// Against d = v^2 / (2 a).
#include "cairn/effects/ground_drag.h"

#include "effect_world.h"

namespace cairn::test::ground_drag_test {
namespace {

using effects::GroundDrag;
using effects::LevelGround;

constexpr btScalar kStep = btScalar(1) / 240, kRadius = btScalar(0.5);

/// Rocks over ground at 100 m, weightless.
struct Flight : EffectWorld {
  Flight() { bullet.world.setGravity(btVector3(0, 0, 0)); }
  btRigidBody& rock(btScalar x, btScalar underside, btScalar speed) {
    return ball(kRadius, 1, btVector3(x, 0, 100 + underside + kRadius), btVector3(0, speed, 0));
  }
  LevelGround ground{100};
};

TEST(GroundDrag, ARockStopsWhereTheLawSaysAndStaysThere) {
  Flight w;
  constexpr btScalar kSpeed = 4, kDeceleration = 2;
  btRigidBody& rock = w.rock(0, btScalar(0.1), kSpeed);
  w.effect<GroundDrag>(GroundDrag::Options{.deceleration = kDeceleration}, w.ground);
  w.step(240, kStep);
  const btScalar rounding = 240 * kSpeed * SIMD_EPSILON;
  EXPECT_NEAR(rock.getLinearVelocity().y(), kSpeed - kDeceleration, rounding);
  w.step(240 * 2, kStep);
  EXPECT_EQ(rock.getLinearVelocity(), btVector3(0, 0, 0));
  // A step's way is that of its last speed: half a step's way less than the integral, all told.
  EXPECT_NEAR(rock.getWorldTransform().getOrigin().y(), kSpeed * kSpeed / (2 * kDeceleration), kSpeed * kStep);
}

TEST(GroundDrag, ActsOnSlowBodiesNearTheGround) {
  Flight w;
  btRigidBody& near = w.rock(0, btScalar(0.9), btScalar(4.9));
  btRigidBody& high = w.rock(3, btScalar(1.1), btScalar(4.9));
  btRigidBody& fast = w.rock(6, btScalar(0.9), btScalar(5.1));
  btRigidBody& still = w.rock(9, btScalar(0.9), 0);
  w.effect<GroundDrag>(GroundDrag::Options{.deceleration = 3}, w.ground);
  w.step(1, kStep);
  EXPECT_LT(near.getLinearVelocity().y(), btScalar(4.9));
  EXPECT_EQ(high.getLinearVelocity().y(), btScalar(4.9));
  EXPECT_EQ(fast.getLinearVelocity().y(), btScalar(5.1));
  EXPECT_EQ(still.getLinearVelocity().y(), 0);
  EXPECT_EQ(w.acted(), 1U);
}

}  // namespace
}  // namespace cairn::test::ground_drag_test
