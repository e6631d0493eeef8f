// SPDX-License-Identifier: Zlib
// Lumped tangential restitution: what 2D tools mean by Rt, once a bounce.
#include "cairn/effects/tangential_restitution.h"

#include <gtest/gtest.h>

#include <optional>
#include <string_view>

#include "cairn/effects/friction.h"
#include "cairn/effects/restitution.h"
#include "effect_world.h"
#include "slope_world.h"

namespace cairn::test::tangential_restitution_test {
namespace {

using effects::PairTable;
using effects::TangentialRestitution;

constexpr btScalar kRadius = btScalar(0.5), kDown = 6, kAlong = 4;

struct Blow {
  btVector3 velocity, spin;
};

Blow blowWith(btScalar part) {
  SlopeWorld world(0, 1000);
  world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.6)));
  world.add<effects::Restitution>(PairTable<btScalar>(btScalar(0.5)), effects::restitution::Constant{});
  world.add<TangentialRestitution>(PairTable<btScalar>(part));
  btRigidBody& ball =
      world.addBody(std::make_shared<btSphereShape>(kRadius), 5, btVector3(0, 0, kRadius + btScalar(0.05)));
  ball.setLinearVelocity(btVector3(kAlong, 0, -kDown));
  ball.setAngularVelocity(btVector3(1, 2, 3));
  world.run(btScalar(0.03));
  EXPECT_EQ(world.set().report()[2].acted, 1U) << "one blow";
  return {ball.getLinearVelocity(), ball.getAngularVelocity()};
}

TEST(TangentialRestitution, LeavesThePartAskedForAndTheSpin) {
  for (const btScalar part : {btScalar(0), btScalar(0.35), btScalar(0.8), btScalar(0.99)}) {
    const Blow blow = blowWith(part);
    EXPECT_NEAR(blow.velocity.x(), part * kAlong, 1e-3 * kAlong) << part;
    EXPECT_NEAR(blow.velocity.y(), 0, 1e-3);
    EXPECT_NEAR((blow.spin - btVector3(1, 2, 3)).length(), 0, 1e-3);
  }
}

// A ball let fall from this many of its radii, which is in its first free flight.
std::uint64_t bouncesFrom(btScalar radii) {
  SlopeWorld world(0, 1000);
  world.add<TangentialRestitution>(PairTable<btScalar>(btScalar(0.5)));
  btRigidBody& ball = world.addBody(std::make_shared<btSphereShape>(kRadius), 5, btVector3(0, 0, kRadius * (1 + radii)),
                                    ballVolume(kRadius));
  ball.setLinearVelocity(btVector3(kAlong, 0, 0));
  world.run(btScalar(0.6));
  return world.set().report()[0].acted;
}

// Of the time of such a fall, a step is 0.3 %: 0.6 % of the height.
TEST(TangentialRestitution, ABounceFollowsAFlightOfAFallThroughTheRadius) {
  static_assert(TangentialRestitution::kFallenRadii == 1);
  EXPECT_EQ(bouncesFrom(btScalar(0.97)), 0U);
  EXPECT_EQ(bouncesFrom(btScalar(1.03)), 1U);
}

/// A rock with corners tumbles down a slope. What it does there, by the part that its bounces leave.
struct Tumble {
  btScalar speed;  // where it has come 100 m, m/s
  std::uint64_t bounces, blows;
};
class Blows final : public effects::Effect, effects::EventHook {
 public:
  std::string_view name() const override { return "blows"; }
  effects::Hooks hooks() override { return {.event = this}; }

 private:
  std::uint32_t noteImpacts(std::span<const effects::Impact> impacts, const effects::Step& /*step*/) override {
    return static_cast<std::uint32_t>(impacts.size());
  }
};
Tumble tumbleWith(std::optional<btScalar> part) {
  constexpr btScalar kSlope = btScalar(35), kWay = 100;
  SlopeWorld world(radians(kSlope));
  world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.6)));
  world.add<effects::Restitution>(PairTable<btScalar>(btScalar(0.3)), effects::restitution::Constant{});
  world.add<Blows>();
  if (part) world.add<TangentialRestitution>(PairTable<btScalar>(*part));
  const btVector3 half(btScalar(0.5), btScalar(0.4), btScalar(0.45)),
      down(btCos(radians(kSlope)), 0, -btSin(radians(kSlope)));
  btRigidBody& rock =
      world.addBody(std::make_shared<btBoxShape>(half), 1900, btVector3(0, 0, 2), 8 * half.x() * half.y() * half.z());
  rock.setWorldTransform(btTransform(btQuaternion(btVector3(1, 2, 3).normalized(), 1), btVector3(0, 0, 2)));
  for (int step = 0; step < 240 * 60 && rock.getWorldTransform().getOrigin().dot(down) < kWay; ++step) world.runStep();
  const auto report = world.set().report();
  return {rock.getLinearVelocity().dot(down), part ? report[3].acted : 0, report[2].acted};
}

TEST(TangentialRestitution, SlowsATumblingRockTheMoreTheLessItLeaves) {
  const Tumble without = tumbleWith(std::nullopt), little = tumbleWith(btScalar(0.95)),
               more = tumbleWith(btScalar(0.8));
  EXPECT_GT(without.speed, little.speed);
  EXPECT_GT(little.speed, more.speed);
  // A bounce takes 5 % of the speed, and between two the slope gives at least g sin 35 sqrt(2 r / g) = 1.7 m/s less
  // what friction takes: no creeping.
  EXPECT_GT(little.speed, without.speed / 2);
  EXPECT_GT(more.speed, 5);
  EXPECT_LT(more.bounces, more.blows) << "not at every corner";
}

TEST(TangentialRestitution, OfOneIsOff) {
  const Tumble without = tumbleWith(std::nullopt), with = tumbleWith(btScalar(1));
  EXPECT_EQ(with.speed, without.speed) << "to the bit";
  EXPECT_EQ(with.bounces, 0U);
}

TEST(TangentialRestitution, LeavesFrictionAtRestAlone) {
  SlopeWorld world(radians(20));
  world.add<effects::Friction>(PairTable<btScalar>(btScalar(0.6)));
  world.add<TangentialRestitution>(PairTable<btScalar>(btScalar(0.9)));
  const btVector3 up(btSin(radians(20)), 0, btCos(radians(20)));
  btRigidBody& box = world.addBody(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(.5))), 10, up * btScalar(.5));
  box.setWorldTransform(btTransform(btQuaternion(btVector3(0, 1, 0), radians(20)), up * btScalar(.5)));
  world.run(3);
  EXPECT_LT((box.getWorldTransform().getOrigin() - up * btScalar(.5)).length(), 0.02) << "0.6 holds at 20 degrees";
}

}  // namespace
}  // namespace cairn::test::tangential_restitution_test
