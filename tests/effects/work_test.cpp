// SPDX-License-Identifier: Zlib
// The work that effects report, against the textbook's loss of energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "cairn/effects/air_drag.h"
#include "cairn/effects/friction.h"
#include "cairn/effects/ground_height.h"
#include "cairn/effects/restitution.h"
#include "cairn/effects/rolling_resistance.h"
#include "cairn/effects/single_trees.h"
#include "cairn/effects/soil_scarring.h"
#include "cairn/effects/tangential_restitution.h"
#include "effect_world.h"
#include "slope_world.h"

namespace cairn::test::work_test {
namespace {

using effects::PairTable;

constexpr btScalar kMass = 1000, kRadius = btScalar(0.5);

effects::Work workOf(SlopeWorld& world, std::string_view name) {
  const auto reports = world.set().report();
  return std::ranges::find(reports, name, &effects::EffectReport::name)->work;
}

btRigidBody& addBall(SlopeWorld& world, const btVector3& place, const btVector3& velocity) {
  btRigidBody& ball = world.addBody(std::make_shared<btSphereShape>(kRadius), kMass, place, ballVolume(kRadius));
  ball.setLinearVelocity(velocity);
  return ball;
}

// A step's part of the way: 1 % of the time that each takes.
constexpr double kOfTheLaw = 0.01;

TEST(WorkOfFriction, IsTheEnergyOfABoxThatSlidesToRest) {
  SlopeWorld world;
  world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.4)));
  btRigidBody& box = world.addBody(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.3))), kMass,
                                   btVector3(0, 0, btScalar(0.3)));
  constexpr btScalar kSpeed = 6;
  box.setLinearVelocity(btVector3(kSpeed, 0, 0));
  world.run(4);
  const effects::Work work = workOf(world, "friction");
  EXPECT_NEAR(work.energyTaken, kMass * kSpeed * kSpeed / 2, kOfTheLaw * kMass * kSpeed * kSpeed / 2);
  EXPECT_NEAR(work.impulse, kMass * kSpeed, kOfTheLaw * kMass * kSpeed);
}

TEST(WorkOfRollingResistance, IsTheEnergyOfABallThatRollsToRest) {
  SlopeWorld world;
  world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.8)));
  world.add<effects::RollingResistance>(PairTable<effects::RollingResistance::Lengths>({.rolling = btScalar(0.05)}));
  constexpr btScalar kSpeed = 2;
  btRigidBody& ball = addBall(world, btVector3(0, 0, kRadius), btVector3(kSpeed, 0, 0));
  ball.setAngularVelocity(btVector3(0, kSpeed / kRadius, 0));
  const double energy = kineticEnergy(ball);
  world.run(4);
  EXPECT_NEAR(workOf(world, "rolling_resistance").energyTaken, energy, kOfTheLaw * energy);
  EXPECT_NEAR(workOf(world, "friction").energyTaken, 0, kOfTheLaw * energy) << "it does not slip";
  // About the contact: I w + r m v with I = 2/5 m r^2.
  EXPECT_NEAR(workOf(world, "rolling_resistance").torqueImpulse, 1.4 * kMass * kRadius * kSpeed,
              kOfTheLaw * 1.4 * kMass * kRadius * kSpeed);
}

TEST(WorkOfRestitution, IsWhatTheBounceDoesNotGiveBack) {
  SlopeWorld world(0, 1000);
  constexpr btScalar kPart = btScalar(0.6), kSpeed = 10;
  world.add<effects::Restitution>(PairTable<btScalar>(kPart), effects::restitution::Constant{});
  addBall(world, btVector3(0, 0, kRadius + btScalar(0.1)), btVector3(0, 0, -kSpeed));
  world.run(btScalar(0.1));
  const double energy = kMass * kSpeed * kSpeed / 2, lost = (1 - kPart * kPart) * energy;
  const effects::Work work = workOf(world, "restitution");
  EXPECT_NEAR(work.energyTaken, lost, 0.03 * lost) << "it is 1 % faster when it lands";
  EXPECT_NEAR(work.impulse, kMass * (1 + kPart) * kSpeed, 0.02 * kMass * (1 + kPart) * kSpeed);
}

TEST(WorkOfAirDrag, IsWhatAFallLacks) {
  SlopeWorld world;
  world.add<effects::AirDrag>(effects::AirDrag::Options{.density = 100});
  const btRigidBody& ball = addBall(world, btVector3(0, 0, 200), btVector3(0, 0, 0));
  world.run(4);
  const double fallen = 200 - ball.getWorldTransform().getOrigin().z();
  const double lacks = kMass * kGravity * fallen - kineticEnergy(ball);
  EXPECT_NEAR(workOf(world, "air_drag").energyTaken, lacks, 0.02 * lacks);
}

TEST(WorkOfAStem, IsWhatItCanTake) {
  static const effects::LevelGround level(-10);
  SlopeWorld world;
  world.add<effects::SingleTrees>(std::vector<effects::SingleTrees::Stem>{{3, 0, btScalar(0.2)}}, level,
                                  effects::SingleTrees::Options{.height = 100, .energyRatio = 1});
  addBall(world, btVector3(0, 0, 50), btVector3(20, 0, 0));
  world.run(btScalar(0.5));
  const double stem = 0.98 * double(effects::SingleTrees::mostEnergy(btScalar(0.2), 1));  // hit in the middle
  EXPECT_NEAR(workOf(world, "trees").energyTaken, stem, 1e-3 * stem);
}

/// A box tumbles down a slope, and everything takes its share.
TEST(WorkOfAllEffects, IsTheEnergyThatIsGone) {
  constexpr btScalar kSlope = btScalar(35);
  SlopeWorld world(radians(kSlope), 1000);
  world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.5)));
  world.add<effects::Restitution>(PairTable<btScalar>(btScalar(0.4)), effects::restitution::Constant{});
  world.add<effects::TangentialRestitution>(PairTable<btScalar>(btScalar(0.9)));
  world.add<effects::AirDrag>(effects::AirDrag::Options{});
  world.add<effects::RollingResistance>(
      PairTable<effects::RollingResistance::Lengths>({btScalar(0.05), btScalar(0.01)}));
  world.add<effects::SoilScarring>(
      std::vector<effects::SoilScarring::Soil>{{}, {.strength = 600, .density = 1800, .drag = btScalar(0.1)}});
  const btVector3 half(btScalar(0.5), btScalar(0.4), btScalar(0.45));
  btRigidBody& rock =
      world.addBody(std::make_shared<btBoxShape>(half), kMass, btVector3(0, 0, 3), 8 * half.x() * half.y() * half.z());
  rock.setAngularVelocity(btVector3(1, 2, 3));
  const auto energy = [&] {
    return double(kineticEnergy(rock)) + double(kMass * kGravity * rock.getWorldTransform().getOrigin().z());
  };
  const double before = energy();
  world.run(8);
  double taken = 0;
  for (const effects::EffectReport& report : world.set().report()) taken += report.work.energyTaken;
  EXPECT_GT(before - energy(), 20 * kMass * kGravity) << "it has fallen";
  EXPECT_NEAR(taken, before - energy(), 0.002 * (before - energy()));
}

}  // namespace
}  // namespace cairn::test::work_test
