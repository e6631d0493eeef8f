// SPDX-License-Identifier: GPL-3.0-or-later
// The energy of each rock, which nothing may raise but other rocks that it touches.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "prepared_scene.h"
#include "rockfall/outputs/merged.h"
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
  void enterBoth() {
    watch.enter(0, first);
    watch.enter(1, second);
  }
  void endStep(bool withSecond = true) {
    watch.follow(0, first);
    if (withSecond) watch.follow(1, second);
    watch.endStep();
  }
};

TEST(Energy_OfARock, RisesByWhatLiftsOrSpeedsOneUp) {
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

TEST(Energy_OfARock, IsRaisedByNoRelease) {
  Rocks rocks;
  rocks.watch.enter(0, rocks.first);
  rocks.endStep(false);
  rocks.watch.enter(1, rocks.second);
  rocks.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.broughtJ(), 2 * 2.0 * kGravityMPerS2 * 5);
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 0);
  rocks.lift(rocks.first, 1);
  rocks.endStep(false);
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 2.0 * kGravityMPerS2);
}

TEST(Energy_OfARock, IsNotHiddenByOthersThatLose) {
  Rocks rocks;
  rocks.lift(rocks.second, 100);
  rocks.enterBoth();
  rocks.lift(rocks.first, 1);
  rocks.lift(rocks.second, 0);
  rocks.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 2.0 * kGravityMPerS2);
  rocks.lift(rocks.first, 0);
  rocks.lift(rocks.second, 0.5);
  rocks.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 2.0 * kGravityMPerS2) << "of one rock, not of both";
}

TEST(Energy_OfARock, MayComeFromRocksThatItTouchesInThatStep) {
  Rocks rocks;
  rocks.first.setLinearVelocity(btVector3(4, 0, 0));
  rocks.enterBoth();
  rocks.first.setLinearVelocity(btVector3(0, 0, 0));
  rocks.second.setLinearVelocity(btVector3(4, 0, 0));
  rocks.watch.meet(1, 0);
  rocks.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 0) << "handed on";
  rocks.first.setLinearVelocity(btVector3(5, 0, 0));
  rocks.second.setLinearVelocity(btVector3(0, 0, 0));
  rocks.watch.meet(0, 1);
  rocks.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 25 - 16) << "more than the other had";
  rocks.first.setLinearVelocity(btVector3(0, 0, 0));
  rocks.second.setLinearVelocity(btVector3(4, 0, 0));
  rocks.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 16) << "they are apart again";
}

TEST(Energy_OfARock, GoesOnInItsPieces) {
  Rocks rocks;
  rocks.watch.enter(0, rocks.first);
  rocks.endStep(false);
  rocks.watch.handOn(0, 1);
  rocks.watch.follow(1, rocks.second);  // all of it in one piece
  rocks.watch.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 0);
  rocks.lift(rocks.second, 1);
  rocks.watch.follow(1, rocks.second);
  rocks.watch.endStep();
  EXPECT_DOUBLE_EQ(rocks.watch.greatestRiseJ(), 2.0 * kGravityMPerS2);
}

TEST(Energy_OfAllRuns, IsThatOfTheWorst) {
  MergedRuns merged;
  for (const double rise : {2.0, 3.0, 1.0}) {
    RunResult result;
    result.energyRiseJ = rise;
    merged.add(result, {});
  }
  EXPECT_EQ(merged.energyRiseJ, 3);
}

// R13 of the textbook's experiments.
TEST(Energy_OfARun, HardlyEverRises) {
  constexpr double kMaxRise = 0.005;  // of the greatest energy of a rock of the run
  const auto fragmentation = json::parse(R"({"effect": "fragmentation", "energy_j_per_kg": 20, "max_generations": 2})");
  for (const char* kind : {"alone", "tight budget", "meeting", "breaking"}) {
    json document = test::plainCase();
    document["effects"].push_back({{"effect", "restitution"}, {"law", "constant"}, {"default", 0.5}});
    if (kind == std::string("tight budget")) document["budget"] = {{"operations", 50}};
    if (kind == std::string("meeting")) document["rocks"][0]["meets_rocks"] = true;
    if (kind == std::string("breaking")) {
      document["rocks"][0]["release"]["above_ground_m"] = 15;
      document["effects"].push_back(fragmentation);
    }
    for (std::uint64_t run = 0; run < 5; ++run) {
      const RunResult result = simulate(test::prepared(document), run).value().result;
      const double greatest = std::ranges::max(result.rocks, {}, &RockRecord::maxEnergyJ).maxEnergyJ;
      ASSERT_GT(greatest, 0);
      EXPECT_LE(result.energyRiseJ, kMaxRise * greatest) << kind << " run " << run;
    }
  }
}

}  // namespace
}  // namespace cairn::rockfall::energy_test
