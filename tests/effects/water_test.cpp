// SPDX-License-Identifier: Zlib
// Sinking against the terminal speed of buoyancy and drag, floating against Archimedes, and the energy of both.
#include "cairn/effects/water.h"

#include <algorithm>
#include <cmath>

#include "effect_world.h"

namespace cairn::test::water_test {
namespace {

using effects::Region;
using effects::Water;

constexpr btScalar kStep = btScalar(1) / 240, kRadius = btScalar(0.1);
// As for air: buoyancy, drag and gravity take turns.
constexpr btScalar kTakingTurns = kGravity * kStep;

TEST(Water, TheSubmergedFractionIsThatOfTheCap) {
  EXPECT_EQ(Water::submergedFraction(2, -2), 0);
  EXPECT_EQ(Water::submergedFraction(2, 0), btScalar(0.5));
  EXPECT_EQ(Water::submergedFraction(2, 2), 1);
  EXPECT_EQ(Water::submergedFraction(2, 50), 1);
  // Discs below the surface, from the bottom up: the midpoint rule's error is under the square of a slice, in radii.
  constexpr int kSlices = 1000;
  double volume = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double top = -1 + 2.0 * (i + 1) / kSlices, middle = top - 1.0 / kSlices;
    volume += (1 - middle * middle) * 2 / kSlices * 0.75;
    EXPECT_NEAR(double(Water::submergedFraction(1, btScalar(top))), volume, 4.0 / kSlices / kSlices);
  }
}

TEST(Water, AStoneSinksAtTheTerminalSpeed) {
  EffectWorld w;
  const Water::Options water{.level = 10};
  const btScalar volume = ballVolume(kRadius), mass = 2600 * volume;
  btRigidBody& stone = w.ball(kRadius, mass, btVector3(0, 0, 0), btVector3(0, 0, 0));
  w.effect<Water>(water);
  w.step(240 * 5, kStep);
  const btScalar weight = (mass - water.density * volume) * kGravity;
  const btScalar terminal = btSqrt(2 * weight / (water.density * water.coefficient * SIMD_PI * kRadius * kRadius));
  EXPECT_NEAR(-stone.getLinearVelocity().z(), terminal, kTakingTurns);
}

/// A ball of 0.4 times water's density.
struct Floating : EffectWorld {
  static constexpr btScalar kPart = btScalar(0.4);
  const Water::Options water;
  const btScalar volume = ballVolume(kRadius), mass = kPart * water.density * volume;
  btRigidBody& body = ball(kRadius, mass, btVector3(0, 0, btScalar(0.5)), btVector3(0, 0, 0));
  Floating() { effect<Water>(water); }

  btScalar height() const { return body.getWorldTransform().getOrigin().z(); }
  // Of motion, of weight, and of the water it presses aside: the integral of the cap's fraction over the depth.
  btScalar energy() const {
    const btScalar h = std::max(btScalar(0), 1 - height() / kRadius), cap = std::min(h, btScalar(2));
    const btScalar pressed = kRadius * (cap * cap * cap / 4 - cap * cap * cap * cap / 16 + (h - cap));
    return kineticEnergy(body) + mass * kGravity * height() + water.density * volume * kGravity * pressed;
  }
};

TEST(Water, ALightBodyFloatsWhereItsWeightSays) {
  Floating w;
  w.step(240 * 30, kStep);
  // The depth whose cap has that part of the volume, by halving.
  btScalar high = kRadius, low = -kRadius;
  for (int i = 0; i < 50; ++i) {
    const btScalar middle = (high + low) / 2;
    (Water::submergedFraction(kRadius, -middle) < Floating::kPart ? high : low) = middle;
  }
  // Under quadratic drag k f a bobbing of frequency w dies away as 3 pi / (4 k f w t). Twice that, for the cap's shape.
  const btScalar k = btScalar(0.5) * w.water.density * w.water.coefficient * SIMD_PI * kRadius * kRadius / w.mass;
  const btScalar section = SIMD_PI * (kRadius * kRadius - high * high);
  const btScalar frequency = btSqrt(w.water.density * kGravity * section / w.mass);
  const btScalar bobbing = 2 * 3 * SIMD_PI / (4 * k * Floating::kPart * frequency * 30);
  ASSERT_LT(bobbing, kRadius / 10);
  EXPECT_NEAR(w.height(), high, bobbing);
}

TEST(Water, TheEnergyOfWhatFallsInFalls) {
  Floating w;
  // Bullet moves a body by the speed it has after the step: its energy is that of a place half a step away, at most a
  // step's way in the strongest force, which is all the buoyancy.
  const btScalar fall = btSqrt(2 * kGravity * btScalar(0.5));
  const btScalar wobble = w.water.density * w.volume * kGravity * fall * kStep;
  btScalar least = w.energy();
  const btScalar start = least;
  for (int i = 0; i < 240 * 10; ++i) {
    w.step(1, kStep);
    EXPECT_LE(w.energy(), least + wobble) << "step " << i;
    least = std::min(least, w.energy());
  }
  EXPECT_LT(least, start / 2) << "most of the fall is spent";
}

TEST(Water, IsWhereItsRegionIs) {
  EffectWorld w;
  w.bullet.world.setGravity(btVector3(0, 0, 0));
  btRigidBody& inside = w.ball(kRadius, 1, btVector3(1, 1, -1), btVector3(0, 1, 0));
  btRigidBody& beside = w.ball(kRadius, 1, btVector3(5, 1, -1), btVector3(0, 1, 0));
  btRigidBody& above = w.ball(kRadius, 1, btVector3(2, 1, kRadius), btVector3(0, 1, 0));
  w.effect<Water>(Water::Options{.region = Region({{0, 0}, {3, 0}, {3, 3}, {0, 3}})});
  w.step(1, kStep);
  EXPECT_LT(inside.getLinearVelocity().y(), 1);
  EXPECT_EQ(beside.getLinearVelocity().y(), 1);
  EXPECT_EQ(above.getLinearVelocity().y(), 1);
  EXPECT_EQ(w.acted(), 1U);
}

TEST(Region, IsTheInsideOfItsPolygonConcaveOrNot) {
  EXPECT_TRUE(Region().contains(btScalar(1e9), btScalar(-1e9)));
  const Region horseshoe({{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
  EXPECT_TRUE(horseshoe.contains(btScalar(0.5), 2));
  EXPECT_TRUE(horseshoe.contains(btScalar(3.5), 2));
  EXPECT_TRUE(horseshoe.contains(2, btScalar(0.5)));
  EXPECT_FALSE(horseshoe.contains(2, 2));
  EXPECT_FALSE(horseshoe.contains(5, btScalar(0.5)));
}

}  // namespace
}  // namespace cairn::test::water_test
