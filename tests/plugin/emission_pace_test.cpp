// SPDX-License-Identifier: Zlib
#include "pairs/emission_pace.h"

#include <gtest/gtest.h>

namespace cairn::bullet::emission_pace_test {
namespace {

constexpr std::uint64_t kOperations = 400;

// A step of forty pairs that each took so long.
void step(EmissionPace& pace, double nanoseconds) {
  for (int i = 0; i < 40; ++i)
    pace.finished(pace.expectedNanoseconds(kOperations), std::chrono::nanoseconds(static_cast<long>(nanoseconds)));
  pace.endStep();
}

TEST(EmissionPace, LearnsWhatAPairTakes) {
  for (const double taken : {300.0, 5000.0, 80000.0}) {
    EmissionPace pace;
    for (int i = 0; i < 200; ++i) step(pace, taken);
    EXPECT_NEAR(pace.expectedNanoseconds(kOperations), taken, 0.01 * taken);
  }
}

TEST(EmissionPace, RisesQuicklyAndFallsSlowly) {
  EmissionPace pace;
  for (int i = 0; i < 200; ++i) step(pace, 1000);
  step(pace, 1200);
  EXPECT_NEAR(pace.expectedNanoseconds(kOperations), 1200, 12);
  step(pace, 1000);
  EXPECT_GT(pace.expectedNanoseconds(kOperations), 1180);
}

TEST(EmissionPace, OneDisturbedStepRaisesItByAQuarterAtMost) {
  EmissionPace pace;
  for (int i = 0; i < 200; ++i) step(pace, 1000);
  step(pace, 1e9);
  EXPECT_LE(pace.expectedNanoseconds(kOperations), 1.26 * 1000);
}

TEST(EmissionPace, TheFirstStepMayRaiseItFourfold) {
  EmissionPace pace;
  const double guess = pace.expectedNanoseconds(kOperations);
  step(pace, 3 * guess);
  EXPECT_NEAR(pace.expectedNanoseconds(kOperations), 3 * guess, 0.01 * guess);
  EmissionPace disturbed;
  step(disturbed, 1000 * guess);
  EXPECT_LE(disturbed.expectedNanoseconds(kOperations), 4.01 * guess);
}

TEST(EmissionPace, IsRaisedToThatOfLess) {
  EmissionPace whole(5), part(20), less(1);
  whole.raiseTo(part);
  EXPECT_EQ(whole.expectedNanoseconds(0), part.expectedNanoseconds(0));
  whole.raiseTo(less);
  EXPECT_EQ(whole.expectedNanoseconds(0), part.expectedNanoseconds(0));
}

// Of pairs that take half of the mean, but every fourth two and a half times it, as caches have it.
TEST(EmissionPace, IsNotDrivenUpByStepsOfFewPairs) {
  for (const double weight : {30.0, 200.0})
    for (const std::uint64_t operations : {0U, 100U, 1000U}) {
      EmissionPace pace(20, weight);
      const auto learn = [&](double nanoseconds) {
        pace.finished(pace.expectedNanoseconds(operations), std::chrono::nanoseconds(static_cast<long>(nanoseconds)));
        pace.endStep();
      };
      for (int i = 0; i < 20000; ++i) learn(10000);
      for (int i = 0; i < 20000; ++i) learn(i % 4 == 0 ? 25000 : 5000);
      EXPECT_LE(pace.expectedNanoseconds(operations), 1.6 * 10000) << weight << ", " << operations;
    }
}

TEST(EmissionPace, AStepWithoutPairsTeachesNothing) {
  EmissionPace pace;
  const double before = pace.expectedNanoseconds(kOperations);
  pace.endStep();
  EXPECT_EQ(pace.expectedNanoseconds(kOperations), before);
}

}  // namespace
}  // namespace cairn::bullet::emission_pace_test
