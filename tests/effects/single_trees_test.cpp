// SPDX-License-Identifier: Zlib
// Against E = 38.7 D^2.31 J a stem and the share of the place that is hit, once a meeting, and against all stems looked
// through one by one.
#include "cairn/effects/single_trees.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "effect_world.h"

namespace cairn::test::single_trees_test {
namespace {

using effects::LevelGround;
using effects::SingleTrees;
using Stem = SingleTrees::Stem;

constexpr btScalar kStep = btScalar(1) / 120, kRadius = btScalar(0.4), kMass = 1000, kSpeed = 20;
// Of a square root and a quotient, and of adding up.
constexpr btScalar kRounding = 100 * SIMD_EPSILON;

/// A weightless rock flies along x at 2 m above level ground, from 5 m before the origin.
struct Wood : EffectWorld {
  Wood() { bullet.world.setGravity(btVector3(0, 0, 0)); }
  SingleTrees& plant(std::vector<Stem> stems, btScalar ratio = 1, btScalar height = 20) {
    return effect<SingleTrees>(std::move(stems), ground, SingleTrees::Options{.height = height, .energyRatio = ratio});
  }
  btRigidBody& rock(btScalar mass = kMass, btScalar speed = kSpeed, btScalar radius = kRadius) {
    return ball(radius, mass, btVector3(-5, 0, 2), btVector3(speed, 0, 0));
  }
  LevelGround ground{0};
};

// Dorren and Berger 2006, as Rockyfor3D states it.
double shareAt(double offset) {
  return std::max(0.0, -0.046 + (0.98 + 0.046) / (1 + std::pow(10, (0.58 - offset) * -8.007)));
}
double lossOf(double centimetres, double offset = 0) {
  return shareAt(offset) * 38.7 * std::pow(centimetres, 2.31);
}

btScalar energyOf(btScalar mass, btScalar speed) {
  return btScalar(0.5) * mass * speed * speed;
}

TEST(SingleTrees, AStemTakesWhatItCan) {
  Wood w;
  w.plant({{0, 0, btScalar(0.2)}});
  btRigidBody& rock = w.rock();
  rock.setAngularVelocity(btVector3(1, 2, 3));
  const btScalar before = kineticEnergy(rock);
  w.step(120, kStep);
  EXPECT_NEAR(kineticEnergy(rock) / (before - btScalar(lossOf(20))), 1, kRounding);
  EXPECT_NEAR(rock.getAngularVelocity().distance(btVector3(1, 2, 3)), 0, 100 * kRounding)
      << "its way forward has enough";
  EXPECT_EQ(w.acted(), 1U);
}

TEST(SingleTrees, AWeakRockStops) {
  Wood w;
  w.plant({{0, 0, 1}});
  btRigidBody& rock = w.rock();
  w.step(120, kStep);
  EXPECT_EQ(rock.getLinearVelocity(), btVector3(0, 0, 0));
  EXPECT_LT(rock.getWorldTransform().getOrigin().x(), 0) << "before the stem's axis";
}

TEST(SingleTrees, AllStemsOfACellCount) {
  Wood w;
  w.plant({{0, 0, btScalar(0.15)}, {btScalar(0.1), btScalar(0.2), btScalar(0.1)}, {500, 500, 1}});
  btRigidBody& rock = w.rock();
  w.step(120, kStep);
  const double loss = lossOf(15) + lossOf(10, 0.2 / (double(kRadius) + 0.05));
  EXPECT_NEAR(kineticEnergy(rock) / (energyOf(kMass, kSpeed) - btScalar(loss)), 1, kRounding);
  EXPECT_EQ(w.acted(), 2U);
}

TEST(SingleTrees, CountsOncePerMeeting) {
  Wood w;
  w.plant({{0, 0, btScalar(0.1)}}, btScalar(0.001));
  btRigidBody& rock = w.rock();
  w.step(120, kStep);
  EXPECT_EQ(w.acted(), 1U);
  rock.setLinearVelocity(-rock.getLinearVelocity());
  w.step(120, kStep);
  EXPECT_EQ(w.acted(), 2U) << "back again";
}

// The published points of the fit: nearly all in the middle, half at 0.57 radii, nothing from 0.75 radii on.
TEST(SingleTrees, TheShareFallsFromTheMiddleToTheEdge) {
  EXPECT_NEAR(SingleTrees::shareOf(0), 0.98, 1e-3);
  EXPECT_NEAR(SingleTrees::shareOf(btScalar(0.58)), 0.467, 1e-3);
  btScalar before = 1;
  for (int i = 0; i <= 100; ++i) {
    const btScalar offset = btScalar(i) / 100, share = SingleTrees::shareOf(offset);
    EXPECT_LE(share, before);
    EXPECT_NEAR(double(share), shareAt(double(offset)), 100 * double(SIMD_EPSILON));
    before = share;
  }
  EXPECT_EQ(SingleTrees::shareOf(btScalar(0.76)), 0);
}

// What its motion towards the axis gives up turns the rock aside, alike on both sides; the rest of it goes on.
TEST(SingleTrees, AHitBesideTheAxisTurnsTheRockAside) {
  constexpr double kStem = 0.3, kReach = double(kRadius) + kStem / 2;
  for (const double offset : {0.1, 0.3, 0.5, 0.65})
    for (const double side : {1.0, -1.0}) {
      Wood w;
      w.plant({{0, btScalar(-side * offset * kReach), btScalar(kStem)}});
      btRigidBody& rock = w.rock();
      w.step(120, kStep);
      const double lost = double(energyOf(kMass, kSpeed) - kineticEnergy(rock));
      EXPECT_NEAR(lost / lossOf(100 * kStem, offset), 1, 1e-3) << offset;
      // Of the level normal: against the way, and away from the axis.
      const double ahead = std::sqrt(1 - offset * offset), closing = double(kSpeed) * ahead;
      const double kept = std::sqrt(closing * closing - 2 * lost / double(kMass));
      const btVector3 velocity = rock.getLinearVelocity();
      EXPECT_NEAR(double(velocity.y()), side * offset * (closing - kept), 1e-3) << offset;
      EXPECT_NEAR(double(velocity.x()), double(kSpeed) - ahead * (closing - kept), 1e-3) << offset;
    }
}

// A stem that takes more than the motion towards it leaves the motion along it, slower.
TEST(SingleTrees, NoRockIsThrownBack) {
  constexpr double kStem = 0.246, kOffset = 0.7, kLightMass = 100, kSlow = 10;
  Wood w;
  w.plant({{0, btScalar(-kOffset * (double(kRadius) + kStem / 2)), btScalar(kStem)}});
  btRigidBody& rock = w.rock(btScalar(kLightMass), btScalar(kSlow));
  w.step(120, kStep);
  const double before = 0.5 * kLightMass * kSlow * kSlow, towards = before * (1 - kOffset * kOffset);
  const double loss = lossOf(100 * kStem, kOffset);
  ASSERT_GT(loss, towards);
  ASSERT_LT(loss, before);
  EXPECT_NEAR(double(kineticEnergy(rock)) / (before - loss), 1, 1e-3);
  const btVector3 direction = rock.getLinearVelocity().normalized();
  EXPECT_NEAR(double(direction.x()), kOffset, 1e-3) << "along the stem's side";
  EXPECT_NEAR(double(direction.y()), std::sqrt(1 - kOffset * kOffset), 1e-3);
}

TEST(SingleTrees, AStemMayHaveAHeightOfItsOwn) {
  for (const btScalar height : {btScalar(1.5), btScalar(3)}) {
    Wood w;
    w.plant({{0, 0, btScalar(0.2), height}});
    btRigidBody& rock = w.rock();
    w.step(120, kStep);
    EXPECT_EQ(rock.getLinearVelocity().x() < kSpeed, height > 2) << "it flies by at 1.6 to 2.4 m";
  }
}

TEST(SingleTrees, ThickerStemsTakeMore) {
  btScalar before = 0;
  for (int centimetres = 5; centimetres <= 150; centimetres += 5) {
    const btScalar energy = SingleTrees::mostEnergy(btScalar(centimetres) / 100, 1);
    EXPECT_GT(energy, before);
    before = energy;
  }
}

TEST(SingleTrees, NoneIsJumpedOver) {
  Wood w;
  // Half a metre a step, a fifth of that wide.
  w.plant({{btScalar(-4.75), 0, btScalar(0.02)}}, btScalar(0.001));
  w.rock(1, 60, btScalar(0.03));
  w.step(1, btScalar(1) / 120);
  EXPECT_EQ(w.acted(), 1U);
}

TEST(SingleTrees, WhatFliesOverThemOrBesideThemIsFree) {
  Wood w;
  SingleTrees& trees = w.plant({{0, 0, btScalar(0.2)}}, 1, btScalar(1.5));
  btRigidBody& over = w.rock();
  btRigidBody& beside = w.ball(kRadius, kMass, btVector3(-5, btScalar(0.6), 1), btVector3(kSpeed, 0, 0));
  EXPECT_EQ(trees.standing(), 1U);
  w.step(120, kStep);
  EXPECT_EQ(over.getLinearVelocity().x(), kSpeed);
  EXPECT_EQ(beside.getLinearVelocity().x(), kSpeed);
}

/// No ground at all.
class Abyss final : public effects::GroundHeight {
 public:
  std::optional<btScalar> at(btScalar, btScalar) const override { return std::nullopt; }
};

TEST(SingleTrees, WithoutGroundNoneStands) {
  const SingleTrees trees({{0, 0, 1}}, Abyss(), {});
  EXPECT_EQ(trees.standing(), 0U);
}

TEST(SingleTrees, TheGridFindsWhatLookingThroughAllFinds) {
  std::mt19937 random(20021);
  std::uniform_real_distribution<double> place(-50, 50), diameter(0.05, 1.2), angle(0, 6.28);
  std::vector<Stem> stems;
  for (int i = 0; i < 2000; ++i)
    stems.push_back({btScalar(place(random)), btScalar(place(random)), btScalar(diameter(random))});
  std::uint64_t all = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Wood w;
    w.plant(stems, btScalar(1e-9));
    const double turn = angle(random);
    const btVector3 direction(btScalar(std::cos(turn)), btScalar(std::sin(turn)), 0);
    const btVector3 from(btScalar(place(random)), btScalar(place(random)), 2);
    w.ball(kRadius, kMass, from, direction * kSpeed);
    w.step(120, kStep);
    // Hits that roundings of a centimetre in 20 m could decide are left to either.
    std::uint64_t least = 0, most = 0;
    for (const Stem& stem : stems) {
      const btVector3 there = btVector3(stem.x, stem.y, 2) - from;
      const btScalar along = std::min(std::max(there.dot(direction), btScalar(0)), kSpeed);
      const btScalar apart = (there - direction * along).length() - stem.diameter / 2 - kRadius;
      const btScalar offset = std::abs(there.cross(direction).z()) / (stem.diameter / 2 + kRadius);
      least += apart < btScalar(-0.01) && offset < btScalar(0.7) ? 1 : 0;  // further out a stem takes nothing
      most += apart < btScalar(0.01) ? 1 : 0;
    }
    EXPECT_GE(w.acted(), least);
    EXPECT_LE(w.acted(), most);
    all += least;
  }
  EXPECT_GT(all, 60U) << "enough to say something";
}

}  // namespace
}  // namespace cairn::test::single_trees_test
