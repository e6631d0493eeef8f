// SPDX-License-Identifier: Zlib
#include "pairs/cost_model.h"

#include <gtest/gtest.h>

namespace cairn::bullet::cost_model_test {
namespace {

constexpr std::uint64_t kOperations = 400;

// A step of forty pairs that each took so long.
void step(CostModel& cost, double nanoseconds) {
  for (int i = 0; i < 40; ++i)
    cost.finished(cost.expectedNanoseconds(kOperations), std::chrono::nanoseconds(static_cast<long>(nanoseconds)));
  cost.endStep();
}

TEST(CostModel, LearnsWhatAPairTakes) {
  for (const double taken : {300.0, 5000.0, 80000.0}) {
    CostModel cost;
    for (int i = 0; i < 200; ++i) step(cost, taken);
    EXPECT_NEAR(cost.expectedNanoseconds(kOperations), taken, 0.01 * taken);
  }
}

TEST(CostModel, RisesQuicklyAndFallsSlowly) {
  CostModel cost;
  for (int i = 0; i < 200; ++i) step(cost, 1000);
  step(cost, 1200);
  EXPECT_NEAR(cost.expectedNanoseconds(kOperations), 1200, 12);
  step(cost, 1000);
  EXPECT_GT(cost.expectedNanoseconds(kOperations), 1180);
}

TEST(CostModel, OneDisturbedStepRaisesItByAQuarterAtMost) {
  CostModel cost;
  for (int i = 0; i < 200; ++i) step(cost, 1000);
  step(cost, 1e9);
  EXPECT_LE(cost.expectedNanoseconds(kOperations), 1.26 * 1000);
}

TEST(CostModel, TheFirstStepMayRaiseItFourfold) {
  CostModel cost;
  const double guess = cost.expectedNanoseconds(kOperations);
  step(cost, 3 * guess);
  EXPECT_NEAR(cost.expectedNanoseconds(kOperations), 3 * guess, 0.01 * guess);
  CostModel disturbed;
  step(disturbed, 1000 * guess);
  EXPECT_LE(disturbed.expectedNanoseconds(kOperations), 4.01 * guess);
}

TEST(CostModel, IsRaisedToThatOfLess) {
  CostModel whole(5), part(20), less(1);
  whole.raiseTo(part);
  EXPECT_EQ(whole.expectedNanoseconds(0), part.expectedNanoseconds(0));
  whole.raiseTo(less);
  EXPECT_EQ(whole.expectedNanoseconds(0), part.expectedNanoseconds(0));
}

// Of pairs that take half of the mean, but every fourth two and a half times it, as caches have it.
TEST(CostModel, IsNotDrivenUpByStepsOfFewPairs) {
  for (const double weight : {30.0, 200.0})
    for (const std::uint64_t operations : {0U, 100U, 1000U}) {
      CostModel cost(20, weight);
      const auto learn = [&](double nanoseconds) {
        cost.finished(cost.expectedNanoseconds(operations), std::chrono::nanoseconds(static_cast<long>(nanoseconds)));
        cost.endStep();
      };
      for (int i = 0; i < 20000; ++i) learn(10000);
      for (int i = 0; i < 20000; ++i) learn(i % 4 == 0 ? 25000 : 5000);
      EXPECT_LE(cost.expectedNanoseconds(operations), 1.6 * 10000) << weight << ", " << operations;
    }
}

TEST(CostModel, AStepWithoutPairsTeachesNothing) {
  CostModel cost;
  const double before = cost.expectedNanoseconds(kOperations);
  cost.endStep();
  EXPECT_EQ(cost.expectedNanoseconds(kOperations), before);
}

}  // namespace
}  // namespace cairn::bullet::cost_model_test
