// SPDX-License-Identifier: GPL-3.0-or-later
// The energy of all rocks together, which nothing may raise.
#include <gtest/gtest.h>

#include "prepared_scene.h"
#include "rockfall/simulation/energy_watch.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall::energy_test {
namespace {

using nlohmann::json;

constexpr double kGravityMPerS2 = 10, kLowestM = -5;
constexpr btScalar kMassKg = 2;

struct Rocks {
  btSphereShape shape{1};
  btRigidBody first{btRigidBody::btRigidBodyConstructionInfo(kMassKg, nullptr, &shape, btVector3(1, 1, 1))};
  btRigidBody second{btRigidBody::btRigidBodyConstructionInfo(kMassKg, nullptr, &shape, btVector3(1, 1, 1))};
  EnergyWatch watch{kGravityMPerS2, kLowestM};

  static void lift(btRigidBody& rock, double heightM) {
    rock.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(heightM))));
  }
  void endStep(bool withSecond = true) {
    watch.follow(0, first);
    if (withSecond) watch.follow(1, second);
    watch.endStep();
  }
};

TEST(Energy_OfAllRocks, RisesByWhatLiftsOrSpeedsOneUp) {
  Rocks rocks;
  rocks.watch.enter(0, rocks.first);
  rocks.endStep(false);
  rocks.lift(rocks.first, -3);
  rocks.endStep(false);
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 0) << "it fell";
  rocks.lift(rocks.first, -1);
  rocks.endStep(false);
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 2.0 * kGravityMPerS2 * 2) << "from where it was lowest";
  rocks.first.setLinearVelocity(btVector3(3, 0, 0));
  rocks.endStep(false);
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 2.0 * kGravityMPerS2 * 2 + 9);
}

TEST(Energy_OfAllRocks, IsRaisedByNoReleaseAndHiddenByNoLoss) {
  Rocks rocks;
  rocks.watch.enter(0, rocks.first);
  rocks.endStep(false);
  rocks.watch.enter(1, rocks.second);
  rocks.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.broughtJ(), 2 * 2.0 * kGravityMPerS2 * 5);
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 0);
  rocks.watch.leave(1);
  rocks.lift(rocks.first, 1);
  rocks.endStep(false);
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 2.0 * kGravityMPerS2);
}

TEST(Energy_OfAllRocks, GoesOnInTheirPieces) {
  Rocks rocks;
  rocks.watch.enter(0, rocks.first);
  rocks.endStep(false);
  rocks.watch.handOn(0);
  rocks.watch.follow(1, rocks.second);  // all of it in one piece
  rocks.watch.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 0);
  rocks.lift(rocks.second, 1);
  rocks.watch.follow(1, rocks.second);
  rocks.watch.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 2.0 * kGravityMPerS2);
}

// R13 of the textbook's experiments.
TEST(Energy_OfARun, HardlyEverRises) {
  constexpr double kMaxRise = 0.005;
  json document = test::plainCase();
  document["effects"].push_back({{"effect", "restitution"}, {"law", "constant"}, {"default", 0.5}});
  for (const char* budget : {"", "tight"}) {
    if (*budget != '\0') document["budget"] = {{"operations", 50}};
    for (std::uint64_t run = 0; run < 5; ++run) {
      const RunResult result = simulate(test::prepared(document), run).value().result;
      ASSERT_GT(result.releasedEnergyJ, 0);
      EXPECT_LE(result.energyRiseJ, kMaxRise * result.releasedEnergyJ) << budget << " run " << run;
    }
  }
}

}  // namespace
}  // namespace cairn::rockfall::energy_test
