// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/frame_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "accuracy_cost/models/solids.h"

namespace cairn::accuracy_cost::frame_time_test {
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
  const std::size_t shapes = table.value().texts("shape").size();
  EXPECT_GE(shapes, 3U);
  EXPECT_EQ(claims.size(), 2 * (shapes + 1)) << "one for each shape in each scene, and the budget of ours";
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

/// Each shape by its own course alone: all by their median, ours by the budget too.
TEST(FrameTimeClaims, TurnWithTheData) {
  const auto within = judgeFrameTime(courseOf(90, 115, 200, 600));
  ASSERT_EQ(within.size(), 3U);
  EXPECT_TRUE(within[0].holds) << "as much as is allowed: " << within[0].found;
  EXPECT_TRUE(within[2].holds) << "three times the median: " << within[2].found;
  const auto late = judgeFrameTime(courseOf(90, 116, 200, 599));
  EXPECT_FALSE(late[0].holds) << "one step in a hundred is over";
  EXPECT_FALSE(late[2].holds) << "slower than the budget in every step, but flat";
  EXPECT_TRUE(judgeFrameTime(courseOf(10, 114, 10, 40))[0].holds) << "ours may be idle between";
  EXPECT_FALSE(judgeFrameTime(courseOf(10, 114, 10, 40))[1].holds) << "which is a spike by the measure of all";
  EXPECT_TRUE(judgeFrameTime(courseOf(10, 114, 10, 40))[2].holds) << "a spike below the budget is one too";
}

TEST(FrameTimeClaims, TellBothRatiosOfEveryShape) {
  const auto claims = judgeFrameTime(courseOf(50, 110, 200, 700));
  ASSERT_EQ(claims.size(), 3U);
  for (const char* words : {"tree in heap of cube", "110 (110 to 110) µs", "2.2 (2.2 to 2.2) times its median",
                            "1.1 (1.1 to 1.1) times the budget of 100 µs", "0.96 of what is allowed"})
    EXPECT_NE(claims[0].found.find(words), std::string::npos) << words << " in: " << claims[0].found;
  for (const char* words :
       {"hull in heap of cube", "3.5 (3.5 to 3.5) times its median", "7 (7 to 7) times the budget of 100 µs",
        "ours by the same measure: 2.2", "100 (100 to 100) % of the steps"})
    EXPECT_NE(claims[2].found.find(words), std::string::npos) << words << " in: " << claims[2].found;
}

}  // namespace
}  // namespace cairn::accuracy_cost::frame_time_test
