// SPDX-License-Identifier: Zlib
#include "dispatch/overrun.h"

#include <gtest/gtest.h>

namespace cairn::bullet {
namespace {

TEST(Overrun, StepsInTimeMayTakeAllOfIt) {
  Overrun overrun;
  EXPECT_EQ(overrun.plannable(500), 500);
  for (int i = 0; i < 10; ++i) overrun.learn(480, 500);
  EXPECT_EQ(overrun.plannable(500), 500);
}

TEST(Overrun, WhatAlwaysTakesLongerIsPlannedToEndEarlier) {
  constexpr double kAllowed = 500, kLonger = 60;
  Overrun overrun;
  for (int i = 0; i < 100; ++i) {
    const double planned = overrun.plannable(kAllowed);
    if (i > 0) EXPECT_NEAR(planned + kLonger, kAllowed, 1e-9);
    overrun.learn(planned + kLonger, planned);
  }
}

TEST(Overrun, OneLongDisturbanceCostsAQuarterAndIsForgotten) {
  constexpr double kAllowed = 500;
  Overrun overrun;
  overrun.learn(8000, kAllowed);
  EXPECT_EQ(overrun.plannable(kAllowed), 0.75 * kAllowed);
  for (int i = 0; i < 200; ++i) overrun.learn(300, kAllowed);
  EXPECT_GT(overrun.plannable(kAllowed), 0.999 * kAllowed);
}

}  // namespace
}  // namespace cairn::bullet
