// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/error_against_time.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "accuracy_cost/experiments/budget_claims.h"
#include "accuracy_cost/experiments/error_against_time_claims.h"
#include "accuracy_cost/experiments/statistics.h"
#include "accuracy_cost/models/solids.h"

namespace cairn::accuracy_cost::error_against_time_test {
namespace {

bool isTime(const std::string& column) {
  return column.starts_with("time_");
}

/// A few tori, few frames: seconds.
Result<Table> smallContest() {
  ContestExtent extent;
  extent.converge = {.bodies = 5, .runs = 1, .frames = 160};
  extent.heap = {.bodies = 6, .from = 30, .frames = 40};
  extent.repetitions = 3;
  extent.depth = 2;
  return measureErrorAgainstTime({{"torus", torus(1, 0.4, 16, 8)}}, extent, 1, {});
}

TEST(ErrorAgainstTime, HasTheSameErrorsTwiceAndPositiveTimes) {
  const auto first = smallContest(), second = smallContest();
  ASSERT_TRUE(first && second) << first.error().message;
  const Table &a = first.value(), &b = second.value();
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_GT(a.rows(), 2U * 12U) << "both scenes, trees by budget and rivals";
  double meeting = 0;
  for (std::size_t row = 0; row < a.rows(); ++row) {
    for (const std::string& column : a.columns()) {
      if (!isTime(column)) EXPECT_EQ(a.text(row, column), b.text(row, column)) << "row " << row << ", " << column;
    }
    EXPECT_GT(a.number(row, "time_us"), 0);
    EXPECT_LE(a.number(row, "time_low_us"), a.number(row, "time_us"));
    EXPECT_GE(a.number(row, "time_high_us"), a.number(row, "time_us"));
    meeting += a.number(row, "meeting_pairs");
    EXPECT_GE(a.number(row, "error_max_fraction"), a.number(row, "point_error_max_fraction")) << "points count";
    EXPECT_GE(a.number(row, "error_max_fraction"), a.number(row, "missed_depth_max_fraction")) << "and what is missed";
    EXPECT_GE(a.number(row, "error_max_fraction"), a.number(row, "false_gap_max_fraction")) << "and what is apart";
    EXPECT_LE(a.number(row, "missed_depth_mean_fraction"), a.number(row, "missed_depth_max_fraction"));
  }
  EXPECT_GT(meeting, 0) << "the frames show nothing";
  EXPECT_FALSE(judgeErrorAgainstTime(a).empty());
  EXPECT_EQ(errorAgainstTimeExperiment().draw(a).front().panels.size(), 2U);
}

TEST(ErrorAgainstTime, CancelsAtOnce) {
  const auto table =
      measureErrorAgainstTime({{"torus", torus(1, 0.4, 16, 8)}}, {}, 1, [](std::string_view, double) { return false; });
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().message, builder::kCancelled);
}

/// One row of a contest as its judge sees it.
struct Row {
  const char* series;
  const char* side;
  double error, time, low, high;
};

Table contestOf(const std::vector<Row>& rows, int beyondCertificate = 0, int pairs = 100) {
  Table table({"model", "scene", "series", "depth", "budget_operations", "time_us", "side", "error_mean_fraction",
               "error_p99_fraction", "error_pairs", "meeting_pairs", "shape", "missed_pairs",
               "missed_depth_max_fraction", "missed_beyond_certificate", "time_over_tree", "time_over_tree_low",
               "time_over_tree_high"});
  for (const Row& r : rows)
    table.add("cube", "heap", r.series, "3", "", r.time, r.side, r.error, r.error, pairs, 10, "tree", beyondCertificate,
              0.01, beyondCertificate, r.time, r.low, r.high);
  return table;
}

const Row kOurs{"tree", "ours", 0.01, 1, 0.95, 1.05}, kFine{"fine", "ours", 0.0005, 4, 3.9, 4.1};

TEST(ErrorAgainstTimeClaims, TurnWithTheData) {
  const Row slower{"slow", "rival", 0.01, 3, 2.9, 3.1};
  EXPECT_TRUE(judgeErrorAgainstTime(contestOf({kOurs, kFine, slower}))[0].holds);

  const Row faster{"fast", "rival", 0.01, 0.5, 0.45, 0.55};
  const Claim beaten = judgeErrorAgainstTime(contestOf({kOurs, kFine, slower, faster}))[0];
  EXPECT_FALSE(beaten.holds);
  EXPECT_NE(beaten.found.find("fast in heap of cube"), std::string::npos) << "the exception is named: " << beaten.found;

  const Row level{"level", "rival", 0.01, 0.97, 0.9, 1.04};
  const Claim tied = judgeErrorAgainstTime(contestOf({kOurs, level}))[0];
  EXPECT_TRUE(tied.holds) << "within the noise";
  EXPECT_NE(tied.found.find("level in heap of cube"), std::string::npos) << tied.found;

  const Row exact{"exact", "rival", 0, 10, 9, 11};
  EXPECT_TRUE(judgeErrorAgainstTime(contestOf({kOurs, kFine, exact}))[0].holds) << "below 0.1 % all is as good";
  EXPECT_FALSE(judgeErrorAgainstTime(contestOf({kOurs, exact}))[0].holds) << "none of ours errs as little";
  const Row crude{"crude", "rival", 0.06, 0.1, 0.1, 0.1};
  EXPECT_TRUE(judgeErrorAgainstTime(contestOf({kOurs, slower, crude}))[0].holds) << "beyond 5 % nothing counts";
}

TEST(ErrorAgainstTimeClaims, SayWhereAQuantileIsTheGreatestError) {
  const Row slower{"slow", "rival", 0.01, 3, 2.9, 3.1};
  const auto many = judgeErrorAgainstTime(contestOf({kOurs, slower})),
             few = judgeErrorAgainstTime(contestOf({kOurs, slower}, 0, 99));
  EXPECT_EQ(many[1].found.find("greatest error"), std::string::npos) << many[1].found;
  EXPECT_NE(few[1].found.find("2 of 2 points"), std::string::npos) << few[1].found;
  EXPECT_EQ(few[0].found.find("greatest error"), std::string::npos) << "the mean is the mean: " << few[0].found;
}

TEST(ErrorAgainstTimeClaims, NoticeAMissedPair) {
  const auto claims = judgeErrorAgainstTime(contestOf({kOurs, kFine}, 1));
  ASSERT_EQ(claims.size(), 1U) << "no rival, no front";
  EXPECT_FALSE(claims[0].holds);
  EXPECT_TRUE(judgeErrorAgainstTime(contestOf({kOurs, kFine}))[0].holds);
}

/// One tree by budget: budget, error, time.
Table budgetsOf(const std::vector<std::array<double, 3>>& points) {
  Table table({"model", "scene", "series", "shape", "depth", "side", "budget_operations", "error_mean_fraction",
               "time_us", "time_over_tree"});
  for (const auto& [budget, error, time] : points)
    table.add("cube", "heap", "by budget", "tree", "3", "ours", budget, error, time, time);
  table.add("cube", "heap", "fewer levels", "tree", "2", "ours", "", 0.02, 1.5, 1.5);
  return table;
}

TEST(ErrorAgainstTimeClaims, TellWhetherErrorFallsWithTheBudgetAndWhichPointsAreDominated) {
  const auto claimOf = [](const Table& table) {
    std::vector<Claim> claims;
    addBudgets(table, claims);
    return claims.at(0);
  };
  const Claim falling = claimOf(budgetsOf({{4000, 0.01, 3}, {2000, 0.05, 2}, {1000, 0.1, 1}}));
  EXPECT_TRUE(falling.holds) << falling.found;
  EXPECT_NE(falling.found.find("1 of 4 points of ours err more"), std::string::npos) << falling.found;
  EXPECT_NE(falling.found.find("2000 operations"), std::string::npos) << falling.found;
  EXPECT_FALSE(claimOf(budgetsOf({{4000, 0.06, 3}, {2000, 0.05, 2}})).holds) << "more operations, more error";
  EXPECT_FALSE(claimOf(budgetsOf({{4000, 0.01, 2}, {2000, 0.05, 3}})).holds) << "more time, more error";
}

TEST(ErrorAgainstTimeClaims, TellHowSureTimesAreWithoutJudgingTheMachine) {
  const Row sure{"slow", "rival", 0.01, 3, 2.9, 3.1}, unsure{"slow", "rival", 0.01, 3, 1.5, 4.5};
  const auto quiet = judgeErrorAgainstTime(contestOf({kOurs, kFine, sure}));
  const auto busy = judgeErrorAgainstTime(contestOf({kOurs, kFine, unsure}));
  ASSERT_EQ(quiet.size(), busy.size());
  for (std::size_t i = 0; i < quiet.size(); ++i) EXPECT_EQ(quiet[i].holds, busy[i].holds);
  EXPECT_NE(quiet[0].found.find("10.0 % at most"), std::string::npos) << quiet[0].found;
  EXPECT_NE(busy[0].found.find("100.0 % at most"), std::string::npos) << busy[0].found;
}

TEST(Statistics_MedianOf, HasTheOrderStatisticsOfTheSignTest) {
  // Conover 1999, table A3: ends of 95 % intervals for the median are the 1st and 6th of 6 values (96.9 %), the 1st and
  // 7th of 7 (98.4 %), the 2nd and 8th of 9 (96.1 %), the 2nd and 10th of 11 (98.8 %), the 6th and 15th of 20 (95.9 %).
  struct Case {
    int count, low, high;
  };
  for (const auto& [count, low, high] : {Case{6, 1, 6}, {7, 1, 7}, {9, 2, 8}, {11, 2, 10}, {20, 6, 15}, {1, 1, 1}}) {
    std::vector<double> values;
    for (int i = count; i > 0; --i) values.push_back(i);
    const MedianInterval interval = medianOf(values);
    EXPECT_EQ(interval.low, low) << count;
    EXPECT_EQ(interval.high, high) << count;
    EXPECT_EQ(interval.median, (count + 1) / 2.0) << count;
  }
}

}  // namespace
}  // namespace cairn::accuracy_cost::error_against_time_test
