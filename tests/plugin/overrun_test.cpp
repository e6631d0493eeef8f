// SPDX-License-Identifier: Zlib
#include "dispatch/overrun.h"

#include <gtest/gtest.h>

namespace cairn::bullet::overrun_test {
namespace {

constexpr double kAllowed = 500;

// One step that takes so much longer than planned, or ends as planned.
double step(Overrun& overrun, double longer) {
  const double planned = overrun.plannable(kAllowed);
  overrun.learn(planned + longer, planned);
  return planned;
}

TEST(Overrun, StepsInTimeMayTakeAllOfIt) {
  Overrun overrun;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(step(overrun, -20), kAllowed);
}

TEST(Overrun, WhatAlwaysTakesLongerIsPlannedToEndEarlier) {
  constexpr double kLonger = 60;
  Overrun overrun;
  step(overrun, kLonger);
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(step(overrun, kLonger) + kLonger, kAllowed, 1e-9);
}

TEST(Overrun, OneLongDisturbanceCostsAQuarterAndIsForgotten) {
  Overrun overrun;
  step(overrun, 8000);
  EXPECT_EQ(step(overrun, 0), 0.75 * kAllowed);
  for (int i = 0; i < 90; ++i) step(overrun, 0);
  EXPECT_GT(step(overrun, 0), 0.99 * kAllowed);
}

TEST(Overrun, OfAnotherBudgetSaysNothing) {
  for (const double other : {60.0, 10000.0}) {
    Overrun overrun;
    const double planned = overrun.plannable(other);
    overrun.learn(2 * other, planned);
    EXPECT_EQ(overrun.plannable(kAllowed), kAllowed);
  }
  Overrun alike;
  alike.plannable(1.9 * kAllowed);
  alike.learn(10 * kAllowed, kAllowed);
  EXPECT_EQ(alike.plannable(kAllowed), 0.75 * kAllowed) << "of a budget nearly twice as long";
  Overrun none;
  none.learn(15, none.plannable(0));
  EXPECT_EQ(none.plannable(0), 0);
}

}  // namespace
}  // namespace cairn::bullet::overrun_test
