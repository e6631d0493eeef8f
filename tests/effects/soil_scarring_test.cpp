// SPDX-License-Identifier: Zlib
// Against d = 0.16 m^(1/4) ME^(-2/5) vn^(4/5), A = pi (2 R d - d^2), F = 1/2 Cd rho A v^2 and the work F d.
#include "cairn/effects/soil_scarring.h"

#include <cmath>

#include "cairn/effects/restitution.h"
#include "effect_world.h"

namespace cairn::test::soil_scarring_test {
namespace {

using effects::SoilScarring;

constexpr effects::MaterialId kRock = 0, kMeadow = 1;
constexpr btScalar kRadius = btScalar(0.5), kMass = 1300, kStep = btScalar(1) / 240;
constexpr SoilScarring::Soil kSoil{.strength = 600, .density = 1800, .drag = btScalar(0.3)};
// Powers of a few roundings each.
constexpr double kRounding = 20 * double(SIMD_EPSILON);

TEST(SoilScarring, DepthGrowsWithThePowerOfTheSpeed) {
  const auto depth = [](btScalar speed) { return SoilScarring::workOf(kSoil, kMass, kRadius, speed, speed).depth; };
  for (btScalar speed = 1; speed < 5; speed *= btScalar(1.5)) {
    const double slope = std::log(double(depth(2 * speed) / depth(speed))) / std::log(2.0);
    EXPECT_NEAR(slope, 0.8, kRounding / std::log(2.0));
    EXPECT_NEAR(double(depth(speed)),
                0.16 * std::pow(double(kMass), 0.25) * std::pow(600.0, -0.4) * std::pow(double(speed), 0.8),
                kRounding * double(depth(speed)));
  }
}

TEST(SoilScarring, NoScarIsDeeperThanTheRadius) {
  const SoilScarring::Work work = SoilScarring::workOf({1, 1800, 1}, kMass, kRadius, 50, 60);
  EXPECT_EQ(work.depth, kRadius);
  const double section = double(SIMD_PI) * double(kRadius) * double(kRadius);
  EXPECT_NEAR(double(work.energy) / (0.5 * 1800 * section * 60 * 60 * double(kRadius)), 1, kRounding);
}

/// A rock falls onto a meadow, along it at the same time, and leaves at half its speed.
struct Blow : EffectWorld {
  Blow() {
    ground(kMeadow);
    effects::PairTable<btScalar> restitution(btScalar(0.5));
    effect<effects::Restitution>(restitution, effects::restitution::Constant{});
    body.setFriction(0);
  }
  // Until it has left the ground again.
  void strike() {
    for (int i = 0; i < 240 && body.getLinearVelocity().z() < 0; ++i) step(1, kStep);
  }
  btRigidBody& body = ball(kRadius, kMass, btVector3(0, 0, 2), btVector3(6, 0, -8));
};

TEST(SoilScarring, ABlowLosesTheWork) {
  Blow without, with;
  SoilScarring& scarring = with.effect<SoilScarring>(std::vector<SoilScarring::Soil>{{}, kSoil});
  without.strike();
  with.strike();
  std::vector<SoilScarring::Scar> scars;
  scarring.scars().takeInto(scars);
  ASSERT_EQ(scars.size(), 1U);
  // The blow's speeds are those of one step; the fall is known to one of its gravity.
  const btScalar normalSpeed = btSqrt(64 + 2 * kGravity * btScalar(1.5)), gravity = 2 * kGravity * kStep;
  const SoilScarring::Work work =
      SoilScarring::workOf(kSoil, kMass, kRadius, normalSpeed, btSqrt(normalSpeed * normalSpeed + 36));
  EXPECT_NEAR(scars[0].depth / work.depth, 1, btScalar(0.8) * gravity / normalSpeed);
  EXPECT_NEAR(scars[0].energy / work.energy, 1, 4 * gravity / normalSpeed);
  EXPECT_NEAR(scars[0].place.z(), 0, normalSpeed * kStep);
  EXPECT_EQ(scars[0].bodyId, 0U);
  const double lost = double(kineticEnergy(without.body) - kineticEnergy(with.body));
  EXPECT_NEAR(lost / double(scars[0].energy), 1, kRounding * double(kineticEnergy(without.body)) / lost);
  const btVector3 a = without.body.getLinearVelocity(), b = with.body.getLinearVelocity();
  EXPECT_NEAR(a.z() / a.x(), b.z() / b.x(), kRounding * 10) << "in its direction";
}

TEST(SoilScarring, TakesNoMoreThanThereIs) {
  Blow blow;
  blow.effect<SoilScarring>(std::vector<SoilScarring::Soil>{{}, {.strength = 1, .density = 5000, .drag = 5}});
  blow.step(240, kStep);
  EXPECT_LT(blow.body.getLinearVelocity().length(), kGravity * kStep * 2) << "stuck where it fell";
}

TEST(SoilScarring, RockIsNoSoil) {
  Blow without, with;
  with.effect<SoilScarring>(std::vector<SoilScarring::Soil>{kSoil});  // of rock only
  without.strike();
  with.strike();
  EXPECT_EQ(without.bullet.stateHash(), with.bullet.stateHash());
}

}  // namespace
}  // namespace cairn::test::soil_scarring_test
