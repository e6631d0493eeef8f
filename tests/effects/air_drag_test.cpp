// SPDX-License-Identifier: Zlib
// Against v^2 = vt^2 (1 - exp(-2 g h / vt^2)), the fall through air from rest.
#include "cairn/effects/air_drag.h"

#include <cmath>

#include "effect_world.h"

namespace cairn::test::air_drag_test {
namespace {

using effects::AirDrag;

constexpr btScalar kStep = btScalar(1) / 240, kRadius = btScalar(0.01), kDensity = 2600;
// Drag and gravity take turns in a step, and places are a step's speed ahead: either is worth half a step's gravity.
constexpr btScalar kTakingTurns = kGravity * kStep;

struct Gravel : EffectWorld {
  btScalar mass = kDensity * ballVolume(kRadius);
  btRigidBody& body = ball(kRadius, mass, btVector3(0, 0, 0), btVector3(0, 0, 0));
  btScalar terminal(const AirDrag::Options& air) const {
    return btSqrt(2 * mass * kGravity / (air.density * air.coefficient * SIMD_PI * kRadius * kRadius));
  }
};

TEST(AirDrag, AFallIsThatOfTheLaw) {
  Gravel gravel;
  const AirDrag::Options air;
  gravel.effect<AirDrag>(air);
  const btScalar square = gravel.terminal(air) * gravel.terminal(air);
  for (int i = 0; i < 10; ++i) {
    gravel.step(120, kStep);
    const btScalar fallen = -gravel.body.getWorldTransform().getOrigin().z();
    const btScalar expected = btSqrt(square * (1 - std::exp(-2 * kGravity * fallen / square)));
    EXPECT_NEAR(-gravel.body.getLinearVelocity().z(), expected, kTakingTurns) << fallen << " m";
  }
}

TEST(AirDrag, EndsAtTheTerminalSpeed) {
  Gravel gravel;
  const AirDrag::Options air;
  gravel.effect<AirDrag>(air);
  gravel.step(240 * 30, kStep);
  EXPECT_NEAR(-gravel.body.getLinearVelocity().z(), gravel.terminal(air), kTakingTurns);
}

TEST(AirDrag, NeverTurnsABodyRound) {
  EffectWorld w;
  w.bullet.world.setGravity(btVector3(0, 0, 0));
  btRigidBody& feather = w.ball(1, btScalar(0.001), btVector3(0, 0, 0), btVector3(300, 400, 0));
  w.effect<AirDrag>(AirDrag::Options{});
  w.step(1, 1);
  const btVector3 velocity = feather.getLinearVelocity();
  EXPECT_GT(velocity.x(), 0);
  EXPECT_LT(velocity.x(), btScalar(0.01));
  EXPECT_NEAR(velocity.y() / velocity.x(), btScalar(4) / 3, 1e-5) << "in its direction";
}

TEST(AirDrag, LeavesTheSlowAndTheUnmeasuredAlone) {
  EffectWorld w;
  w.bullet.world.setGravity(btVector3(0, 0, 0));
  btRigidBody& slow = w.ball(1, 1, btVector3(0, 0, 0), btVector3(2, 0, 0));
  btRigidBody& unmeasured = w.bullet.add(std::make_shared<btSphereShape>(btScalar(1)), 1, btVector3(0, 9, 0));
  unmeasured.setLinearVelocity(btVector3(9, 0, 0));
  w.join(unmeasured, 0);
  w.effect<AirDrag>(AirDrag::Options{.leastSpeed = 3});
  w.step(10, kStep);
  EXPECT_EQ(w.acted(), 0U);
  EXPECT_EQ(slow.getLinearVelocity().x(), 2);
  EXPECT_EQ(unmeasured.getLinearVelocity().x(), 9);
}

}  // namespace
}  // namespace cairn::test::air_drag_test
