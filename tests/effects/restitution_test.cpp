// SPDX-License-Identifier: Zlib
// Restitution by pair and speed, against its laws and against bouncing balls of the textbook.
#include "cairn/effects/restitution.h"

#include <gtest/gtest.h>

#include <vector>

#include "cairn/effects/friction.h"
#include "slope_world.h"

namespace cairn::test::restitution_test {
namespace {

using effects::PairTable;
using effects::Restitution;
namespace restitution = effects::restitution;

constexpr btScalar kRadius = btScalar(0.5);

TEST(RestitutionLaw, HasItsValuesAndLimits) {
  EXPECT_EQ(restitution::at(restitution::Constant{}, btScalar(0.6), 20), btScalar(0.6));
  const restitution::Pfeiffer pfeiffer;
  EXPECT_EQ(restitution::at(pfeiffer, btScalar(0.6), 0), btScalar(0.6));
  EXPECT_NEAR(restitution::at(pfeiffer, btScalar(0.6), btScalar(9.144)), 0.3, 1e-6);
  EXPECT_NEAR(restitution::at(restitution::Bourrier{}, 4, 4), 0.5, 1e-6);
  EXPECT_EQ(restitution::at(restitution::Bourrier{}, 0, 0), 0);
  for (btScalar speed = 0; speed < 50; speed += btScalar(0.5)) {
    EXPECT_GE(restitution::at(pfeiffer, btScalar(0.6), speed), restitution::at(pfeiffer, btScalar(0.6), speed + 1));
    EXPECT_GE(restitution::at(restitution::Bourrier{}, 4, speed),
              restitution::at(restitution::Bourrier{}, 4, speed + 1));
  }
}

/// Heights of the bounces of a ball dropped from `height`, above its radius.
std::vector<btScalar> bounces(SlopeWorld& world, std::shared_ptr<btCollisionShape> shape, btScalar height,
                              btScalar seconds) {
  btRigidBody& ball = world.addBody(std::move(shape), 5, btVector3(0, 0, kRadius + height));
  std::vector<btScalar> heights;
  btScalar before = 0;
  for (btScalar t = 0; t < seconds; t += world.stepLength()) {
    const btScalar speed = ball.getLinearVelocity().z();
    if (before > 0 && speed <= 0) heights.push_back(ball.getWorldTransform().getOrigin().z() - kRadius);
    before = speed;
    world.runStep();
  }
  return heights;
}

struct Drop {
  btScalar restitution, stepsPerSecond;
};

class RestitutionDrop : public testing::TestWithParam<Drop> {};

TEST_P(RestitutionDrop, BouncesToTheTextbooksHeight) {
  const Drop drop = GetParam();
  SlopeWorld world(0, drop.stepsPerSecond);
  world.add<Restitution>(PairTable<btScalar>(drop.restitution), restitution::Constant{});
  constexpr btScalar kHeight = 10;
  const std::vector<btScalar> heights = bounces(world, std::make_shared<btSphereShape>(kRadius), kHeight, 6);
  ASSERT_GE(heights.size(), 2U);
  // It leaves up to one step's way above or below the ground, at most twice for the second bounce, and with up to one
  // step's gravity too much or too little.
  btScalar expected = kHeight, error = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const btScalar speed = btSqrt(2 * kGravity * expected);
    error = drop.restitution * drop.restitution * error + 2 * speed * world.stepLength();
    expected *= drop.restitution * drop.restitution;
    EXPECT_NEAR(heights[i], expected, error) << "bounce " << i;
    std::printf("bounce %zu at %g Hz, e %g: %.3f m, exact %.3f\n", i, double(drop.stepsPerSecond),
                double(drop.restitution), double(heights[i]), double(expected));
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, RestitutionDrop,
                         testing::Values(Drop{btScalar(0.5), 60}, Drop{btScalar(0.5), 240}, Drop{btScalar(0.5), 1000},
                                         Drop{1, 60}, Drop{1, 240}, Drop{1, 1000}));

TEST(Restitution, IsTheLawsAtTheSpeedOfTheBlow) {
  for (const btScalar height : {btScalar(1), btScalar(5), btScalar(20)}) {
    SlopeWorld world(0, 1000);
    world.add<Restitution>(PairTable<btScalar>(btScalar(0.8)), restitution::Pfeiffer{});
    const std::vector<btScalar> heights = bounces(world, std::make_shared<btSphereShape>(kRadius), height, 4);
    ASSERT_FALSE(heights.empty());
    const btScalar speed = btSqrt(2 * kGravity * height);
    const btScalar part = restitution::at(restitution::Pfeiffer{}, btScalar(0.8), speed);
    EXPECT_NEAR(heights.front(), part * part * height, 2 * speed * world.stepLength());
  }
}

TEST(Restitution, ZeroStaysDown) {
  SlopeWorld world;
  world.add<Restitution>(PairTable<btScalar>(0), restitution::Constant{});
  btRigidBody& ball = world.addBody(std::make_shared<btSphereShape>(kRadius), 5, btVector3(0, 0, kRadius + 1));
  ball.setRestitution(1);  // overridden
  world.run(btScalar(1.5));
  EXPECT_LT(ball.getWorldTransform().getOrigin().z(), kRadius + btScalar(0.05));
}

/// R9: an oblique blow grips if friction suffices, else slips.
TEST(Restitution, ObliqueBlowsGripOrSlip) {
  constexpr btScalar kDown = 6, kAlong = 4, kRestitution = btScalar(0.5);
  for (const btScalar friction : {btScalar(0.05), btScalar(0.1), btScalar(0.3), btScalar(0.6)}) {
    SlopeWorld world(0, 1000);
    world.add<effects::Friction>(PairTable<btScalar>(friction));
    world.add<Restitution>(PairTable<btScalar>(kRestitution), restitution::Constant{});
    btRigidBody& ball =
        world.addBody(std::make_shared<btSphereShape>(kRadius), 5, btVector3(0, 0, kRadius + btScalar(0.05)));
    ball.setLinearVelocity(btVector3(kAlong, 0, -kDown));
    world.run(btScalar(0.02));
    const bool grips = friction >= 2 * kAlong / (7 * (1 + kRestitution) * kDown);
    const btScalar expected = grips ? btScalar(5) / 7 * kAlong : kAlong - friction * (1 + kRestitution) * kDown;
    EXPECT_NEAR(ball.getLinearVelocity().x(), expected, btScalar(0.02) * kAlong) << "friction " << friction;
    EXPECT_NEAR(ball.getLinearVelocity().z(), kRestitution * kDown, btScalar(0.02) * kDown + kGravity * btScalar(0.02));
  }
}

}  // namespace
}  // namespace cairn::test::restitution_test
