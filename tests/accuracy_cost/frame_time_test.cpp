// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/frame_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "accuracy_cost/models/solids.h"

namespace cairn::accuracy_cost {
namespace {

TEST(FrameTime, HasEveryStepOfEveryRun) {
  FrameTimeExtent extent{.heapBodies = 4,
                         .crushBodies = 3,
                         .steps = 30,
                         .repetitions = 2,
                         .heapBudgetUs = 100,
                         .crushBudgetUs = 100,
                         .depth = 2};
  const auto table = measureFrameTime({{"torus", torus(1, 0.4, 16, 8)}}, extent, 1, {});
  ASSERT_TRUE(table) << table.error().message;
  for (const char* scene : {"heap", "crush"})
    for (const char* shape : {"tree", "gimpact", "hull"}) {
      const auto times = table.value().numbers("narrow_phase_us", {{"scene", scene}, {"shape", shape}});
      EXPECT_EQ(times.size(), 60U) << scene << " of " << shape;
      EXPECT_GT(*std::ranges::min_element(times), 0);
    }
  const auto claims = judgeFrameTime(table.value());
  EXPECT_EQ(claims.size(), 6U);
  EXPECT_EQ(frameTimeExperiment().draw(table.value()).front().panels.size(), 2U);
}

/// Six runs of a hundred steps: the tree takes `ours` us, in one step of each `slowest`; a rival `theirs`, likewise.
Table courseOf(double ours, double slowest, double theirs, double theirSlowest) {
  Table table({"model", "scene", "shape", "side", "run", "step", "narrow_phase_us", "budget_us", "allowance_us"});
  for (int run = 1; run <= 6; ++run)
    for (int step = 1; step <= 100; ++step) {
      table.add("cube", "heap", "tree", "ours", run, step, step == 7 ? slowest : ours, 100, 115);
      table.add("cube", "heap", "hull", "rival", run, step, step == 7 ? theirSlowest : theirs, 100, "");
    }
  return table;
}

TEST(FrameTimeClaims, TurnWithTheData) {
  const auto within = judgeFrameTime(courseOf(90, 114, 200, 700));
  ASSERT_EQ(within.size(), 3U);
  for (const Claim& claim : within) EXPECT_TRUE(claim.holds) << claim.found;
  const auto late = judgeFrameTime(courseOf(90, 120, 200, 500));
  EXPECT_FALSE(late[0].holds) << "the slowest step in a thousand is over";
  EXPECT_TRUE(late[1].holds) << "but only one in a hundred";
  EXPECT_FALSE(late[2].holds) << "2.5 times the median is no spike";
  EXPECT_FALSE(judgeFrameTime(courseOf(120, 120, 200, 500))[1].holds);
  EXPECT_FALSE(judgeFrameTime(courseOf(90, 100, 90, 100))[1].holds) << "rivals are as flat";
}

}  // namespace
}  // namespace cairn::accuracy_cost
