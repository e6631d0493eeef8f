// SPDX-License-Identifier: Zlib
// The order of turns in cases small enough to be worked out by hand. A new pair has age 1, so its rank counts twice
// until it is served; every other turn belongs to whoever has waited longest.
#include "cairn/core/priority.h"

#include <gtest/gtest.h>

#include <deque>
#include <limits>
#include <numbers>

#include "cairn/core/perceptual.h"
#include "cairn/core/round_robin.h"
#include "cairn/core/two_classes.h"
#include "cairn/core/worst_error_first.h"
#include "scripted_traversal.h"

namespace cairn::test::priority_test {
namespace {

using Order = std::vector<int>;

struct Script {
  std::deque<ScriptedTraversal> traversals;
  std::vector<ScheduledPair> pairs;
  Order log;

  ScheduledPair& add(int id, std::vector<float> errors) {
    traversals.emplace_back(id, std::move(errors), log);
    pairs.push_back({.id = static_cast<std::uint64_t>(id), .traversal = &traversals.back()});
    return pairs.back();
  }
  /// Steps of so many turns each.
  const Order& run(Priority& priority, int steps, int turns) {
    for (int i = 0; i < steps; ++i) {
      Budget budget = Budget::operations(static_cast<std::uint64_t>(turns) * Scheduler::kTurnOperations);
      (void)Scheduler().run(pairs, priority, budget);
    }
    return log;
  }
};

TEST(PriorityOrder, RoundRobin_GivesTurnsInTheOrderOfIds) {
  Script script;
  script.add(3, {1, 1});
  script.add(1, {9, 9, 9});
  script.add(2, {5});
  RoundRobin priority;
  EXPECT_EQ(script.run(priority, 1, 99), (Order{1, 2, 3, 1, 3, 1}));
}

TEST(PriorityOrder, WorstErrorFirst_ServesTheWorstFront) {
  Script script;
  script.add(1, {1, 0.2F});
  script.add(2, {3, 2});
  script.add(3, {2.5F});
  WorstErrorFirst priority;
  // Ranks 2 6 5: 2. The line: 1. Ranks 0.2 2 5: 3, done. The line: 2, done. Then 1.
  EXPECT_EQ(script.run(priority, 1, 99), (Order{2, 1, 3, 2, 1}));
}

TEST(PriorityOrder, WorstErrorFirst_LooksAtTheWholeFrontNotOnlyAtItsHead) {
  Script script;
  script.add(1, {2});
  script.add(2, {1, 1, 3});
  WorstErrorFirst priority;
  // 2 leads with 6 to 4. The line: 1, done. Then 2.
  EXPECT_EQ(script.run(priority, 1, 99), (Order{2, 1, 2, 2}));
}

TEST(PriorityOrder, WorstErrorFirst_MeasuresInSizesOfTheSmallerBody) {
  Script script;
  script.add(1, {5}).size = 10;
  script.add(2, {1}).size = 1;
  WorstErrorFirst priority;
  EXPECT_EQ(script.run(priority, 1, 99), (Order{2, 1}));
}

TEST(PriorityOrder, WorstErrorFirst_CountsAnAnswerThatNoLongerHolds) {
  Script script;
  script.add(1, {2, 2});
  script.add(2, {0.1F, 0.1F}).unansweredError = 3;
  WorstErrorFirst priority;
  // 4 to 6: 2. The line: 1. Then 2 to 3: 2, done, however small its front's error was.
  EXPECT_EQ(script.run(priority, 1, 99), (Order{2, 1, 2, 1}));
}

TEST(PriorityOrder, EveryOtherTurnGoesToWhoHasWaitedLongest) {
  Script script;
  script.add(1, {1, 1});
  script.add(2, {9, 9, 9, 9, 9});
  script.add(3, {2, 2});
  WorstErrorFirst priority;
  EXPECT_EQ(script.run(priority, 1, 99), (Order{2, 1, 2, 3, 2, 1, 2, 3, 2}));
}

TEST(PriorityOrder, RanksGrowWithAge) {
  Script script;
  script.add(1, std::vector<float>(20, 3));
  script.add(2, std::vector<float>(20, 2));
  script.add(3, std::vector<float>(20, 2));
  WorstErrorFirst priority;
  // One turn a step. Ranks: 6 4 4; the line: 2; ranks 6 2 8; the line: 1; ranks 3 6 4; the line: 3; ranks 9 4 2.
  EXPECT_EQ(script.run(priority, 7, 1), (Order{1, 2, 3, 1, 2, 3, 1}));
}

TEST(PriorityOrder, EqualRanksGoByIdAtFirstAndInTurnAfterwards) {
  Script script;
  for (const int id : {4, 2, 3}) script.add(id, {1, 1});
  WorstErrorFirst priority;
  EXPECT_EQ(script.run(priority, 1, 99), (Order{2, 3, 4, 2, 3, 4}));
}

TEST(PriorityOrder, WhatIsNotANumberHasNoRankButItsPlaceInLine) {
  Script script;
  script.add(1, {1}).size = std::numeric_limits<float>::quiet_NaN();
  script.add(2, std::vector<float>(5, 1));
  WorstErrorFirst priority;
  EXPECT_EQ(script.run(priority, 1, 99), (Order{2, 1, 2, 2, 2, 2}));
}

TEST(PriorityOrder, TwoClasses_FastPairsFirst_InTurnInsideEachClass) {
  Script script;
  script.add(1, {9, 9, 9}).closingSpeed = 0.5F;
  script.add(2, {1, 1, 1}).closingSpeed = 2;
  script.add(3, {1, 1, 1}).closingSpeed = 3;
  TwoClasses priority;
  EXPECT_EQ(script.run(priority, 1, 99), (Order{2, 1, 3, 2, 3, 1, 2, 3, 1}));
}

TEST(PriorityOrder, TwoClasses_SpeedCountsInSizes) {
  Script script;
  script.add(1, {1}).closingSpeed = 0.5F;
  auto& small = script.add(2, {1});
  small.closingSpeed = 0.5F;
  small.size = 0.4F;
  TwoClasses priority;
  EXPECT_EQ(script.run(priority, 1, 99), (Order{2, 1}));
}

Viewer alongX(double fieldOfView = 1) {
  return {.eye = {0, 0, 0}, .direction = {2, 0, 0}, .focus = {10, 0, 0}, .fieldOfView = fieldOfView};
}

TEST(PriorityOrder, TwoClasses_WithAViewer_WhatIsNearTheGazeFirst) {
  Script script;
  script.add(1, {1}).center = {10, 3, 0};    // 17 degrees off
  script.add(2, {1}).center = {-10, 0, 0};   // behind
  script.add(3, {1}).center = {10, 0.5, 0};  // touches the gaze
  script.pairs[0].closingSpeed = 100;        // does not count any more
  TwoClasses priority;
  priority.setViewer(alongX());
  EXPECT_EQ(script.run(priority, 1, 99), (Order{3, 1, 2}));
}

TEST(PriorityOrder, Perceptual_WithoutAViewer_WeighsErrorByMomentum) {
  // Mean momentum 1: factors 1/2 and 1/2 + 2/3, so 2 x 1/2 < 1 x 7/6 < 2.5 x 1/2.
  for (const float error : {2.0F, 2.5F}) {
    Script script;
    script.add(1, {error}).mass = 1;
    auto& moving = script.add(2, {1});
    moving.mass = 0.5F;
    moving.closingSpeed = 4;
    Perceptual priority;
    EXPECT_EQ(script.run(priority, 1, 99), error < 2.2F ? (Order{2, 1}) : (Order{1, 2})) << error;
  }
}

TEST(PriorityOrder, Perceptual_WithAViewer_NearThenFarThenAsideThenBehind) {
  Script script;
  script.add(1, {1}).center = {-10, 0, 0};   // 0.0139 acuity / 10 / 16
  script.add(2, {1}).center = {8.66, 5, 0};  // 30 degrees off less 2.9: 0.084 / 10
  script.add(3, {1}).center = {20, 0, 0};    // 1 / 20
  script.add(4, {1}).center = {10, 0, 0};    // 1 / 10
  for (const int first : {4, 3, 2}) {        // which is then done
    Perceptual priority;
    priority.setViewer(alongX(1.5));
    script.log.clear();
    EXPECT_EQ(script.run(priority, 1, 1), Order{first});
  }
  for (ScriptedTraversal& t : script.traversals) t.restart();
  script.log.clear();
  Perceptual priority;
  priority.setViewer(alongX(1.5));
  priority.setViewer({});
  EXPECT_EQ(script.run(priority, 1, 1), Order{1}) << "nobody looks any more: equal ranks, by id";
}

TEST(PriorityImportance, IsTheRankWithoutErrorAndAge_ForErrorsAsFractionsOfSize) {
  ScheduledPair near{.id = 1, .center = {10, 0, 0}, .size = 2, .closingSpeed = 1},
      behind{.id = 2, .center = {-10, 0, 0}};
  EXPECT_EQ(RoundRobin().importance(near), 1);
  EXPECT_EQ(WorstErrorFirst().importance(near), 1) << "errors are told in sizes";
  TwoClasses classes;
  EXPECT_EQ(classes.importance(near), TwoClasses::kLowWeight) << "needs two seconds for its size";
  near.closingSpeed = 3;
  EXPECT_EQ(classes.importance(near), 1);
  Perceptual perceptual;
  EXPECT_EQ(perceptual.importance(near), 2) << "without a viewer its size, and nothing is known of momenta";
  for (Priority* policy : std::initializer_list<Priority*>{&classes, &perceptual}) policy->setViewer(alongX());
  EXPECT_EQ(classes.importance(behind), TwoClasses::kLowWeight);
  EXPECT_EQ(perceptual.importance(near), 2 / 10.0);
  EXPECT_LT(perceptual.importance(behind), 1 / 160.0);
}

TEST(Viewer, SightOfABall) {
  const Viewer viewer = alongX();
  const Sight ahead = sightOf(viewer, {10, 0, 0}, 0.5);
  EXPECT_TRUE(ahead.isVisible);
  EXPECT_EQ(ahead.distance, 10);
  EXPECT_EQ(ahead.eccentricity, 0);
  const Sight aside = sightOf(viewer, {0, 10, 0}, 5);
  EXPECT_NEAR(aside.eccentricity, std::numbers::pi / 3, 1e-12) << "90 degrees off, 30 of which the ball fills";
  EXPECT_FALSE(aside.isVisible) << "half the field of view is 0.5";
  EXPECT_TRUE(sightOf(viewer, {10, 5.6, 0}, 0.5).isVisible) << "0.5104 off, 0.0436 of which the ball fills";
  const Sight around = sightOf(viewer, {-1, 0, 0}, 3);
  EXPECT_TRUE(around.isVisible) << "the eye is inside";
  EXPECT_EQ(around.distance, 3);
  EXPECT_FALSE(sightOf(viewer, {std::numeric_limits<double>::quiet_NaN(), 0, 0}, 1).isVisible);
}

TEST(Viewer, WhoseGazeIsUnknownLooksStraightAhead) {
  Viewer viewer = alongX();
  viewer.focus = viewer.eye;
  EXPECT_EQ(sightOf(viewer, {10, 0, 0}, 0.5).eccentricity, 0);
}

TEST(Viewer, SeenErrorIsAnAngleWeighedByAcuity) {
  EXPECT_EQ(seenError({.distance = 4, .eccentricity = 0, .isVisible = true}, 0.2), 0.05);
  EXPECT_EQ(seenError({.distance = 4, .eccentricity = kHalfAcuityEccentricity, .isVisible = true}, 0.2), 0.025);
  EXPECT_EQ(seenError({.distance = 4, .eccentricity = 0, .isVisible = false}, 0.2), 0);
}

TEST(Viewer, NonsenseIsRefused) {
  EXPECT_TRUE(checkViewer(alongX()).ok());
  Viewer nowhere = alongX(), blind = alongX(0), beside = alongX(7), lost = alongX();
  nowhere.direction = {};
  lost.eye.x = std::numeric_limits<double>::quiet_NaN();
  for (const Viewer& viewer : {nowhere, blind, beside, lost}) EXPECT_FALSE(checkViewer(viewer).ok());
}

}  // namespace
}  // namespace cairn::test::priority_test
