// SPDX-License-Identifier: GPL-3.0-or-later
// Quantiles of measured values and their confidence: against a binomial distribution added up here, and by how often
// the intervals hold the truth.
#include "rockfall/outputs/sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "random_tree.h"
#include "rockfall/outputs/enough_runs.h"

namespace cairn::rockfall::sample_test {
namespace {

using test::uniform;

Sample wholeNumbers(int count) {
  std::vector<double> values;
  for (int i = count; i > 0; --i) values.push_back(i);
  return Sample(values);
}

/// P(at most k) of n trials, each with success p, term by term. The first are below the least double.
double upTo(int k, int n, double p) {
  long double term = std::pow(1 - static_cast<long double>(p), n), sum = 0;
  for (int i = 0; i <= k; ++i) {
    sum += term;
    term *= (n - i) * p / ((i + 1) * (1 - p));
  }
  return static_cast<double>(sum);
}

TEST(Sample, GivesNearestRanks) {
  const Sample sample = wholeNumbers(200);
  EXPECT_EQ(sample.mean(), 100.5);
  EXPECT_EQ(sample.greatest(), 200);
  EXPECT_EQ(sample.quantile(500), 100);
  EXPECT_EQ(sample.quantile(950), 190);
  EXPECT_EQ(sample.quantile(990), 198);
  EXPECT_EQ(sample.quantile(1000), 200);
  EXPECT_EQ(wholeNumbers(1).quantile(950), 1);
  EXPECT_EQ(wholeNumbers(0).quantile(950), 0);
}

TEST(Sample, BoundsAreTheTightestOfTheBinomialDistribution) {
  constexpr double kTail = 0.025;
  for (const int count : {1, 2, 20, 71, 72, 73, 100, 500})
    for (const std::uint32_t thousandths : {500U, 950U}) {
      const Interval found = wholeNumbers(count).confidence(thousandths);
      const double p = thousandths / 1000.0;
      const auto low = static_cast<int>(found.low);
      EXPECT_TRUE(low == 0 || upTo(low - 1, count, p) <= kTail) << count;
      EXPECT_GT(upTo(low, count, p), kTail) << "one more would be too many, of " << count;
      if (!found.high) {
        EXPECT_LT(upTo(count - 1, count, p), 1 - kTail) << count;
        continue;
      }
      const auto high = static_cast<int>(*found.high);
      EXPECT_GE(upTo(high - 1, count, p), 1 - kTail) << count;
      EXPECT_TRUE(high == 1 || upTo(high - 2, count, p) < 1 - kTail) << count;
    }
  EXPECT_FALSE(wholeNumbers(71).confidence(950).high) << "0.95^71 = 0.026";
  EXPECT_TRUE(wholeNumbers(72).confidence(950).high) << "0.95^72 = 0.0249";
}

TEST(Sample, BoundsHoldTheTruthNineteenTimesInTwenty) {
  constexpr std::uint64_t kSeed = 9;
  std::mt19937_64 engine(kSeed);
  constexpr int kTrials = 2000, kValues = 300;
  int held = 0, shareHeld = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values;
    std::uint64_t some = 0;
    for (int i = 0; i < kValues; ++i) {
      values.push_back(uniform(engine, 0, 1));
      some += values.back() < 0.1;
    }
    const Interval found = Sample(values).confidence(950);
    held += found.low <= 0.95 && found.high && 0.95 <= *found.high;
    const Interval share = confidenceOfShare(some, kValues);
    shareHeld += share.low <= 0.1 && 0.1 <= *share.high;
  }
  const double slack = 4 * std::sqrt(kTrials * 0.05 * 0.95);
  EXPECT_GT(held, 0.95 * kTrials - slack) << "never fewer";
  // Wilson's is right on average over shares, and a per cent off at some.
  EXPECT_NEAR(shareHeld, 0.95 * kTrials, slack + 0.01 * kTrials);
}

TEST(ConfidenceOfShare, OfNoneAndOfAllHasItsEnd) {
  for (std::uint64_t all = 1; all < 1000; ++all) {
    EXPECT_EQ(confidenceOfShare(0, all).low, 0) << all;
    EXPECT_EQ(confidenceOfShare(all, all).high, 1) << all;
  }
}

TEST(EnoughRuns, AsksForMoreUntilTheBoundsAreATenth) {
  constexpr std::uint64_t kSeed = 10;
  std::mt19937_64 engine(kSeed);
  const auto skewed = [&](int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(std::exp(uniform(engine, 0, 10)));
    return Runouts{values};
  };
  const auto few = checkQuantiles(skewed(30), {}, 10).at(0);
  EXPECT_FALSE(few.bounds.high);
  EXPECT_FALSE(few.isEnough(10));
  EXPECT_EQ(few.runs, 24U) << "72 values of three a run";
  EXPECT_NE(enoughText({few}, 10).find("at least 24 runs are needed to tell"), std::string::npos)
      << enoughText({few}, 10);
  const auto some = checkQuantiles(skewed(150), {}, 150).at(0);
  EXPECT_FALSE(some.isEnough(150)) << enoughText({some}, 150);
  const auto many = checkQuantiles(skewed(20000), {}, 20000).at(0);
  EXPECT_TRUE(many.isEnough(20000)) << enoughText({many}, 20000);
  EXPECT_NE(enoughText({many}, 20000).find("the runs are enough"), std::string::npos);
}

// Rocks that the map's edge or the end of the time stopped may be those that go farthest.
TEST(EnoughRuns, AreNoneWhereMoreThanOneRockInTwentyIsCutOff) {
  const auto checkOf = [](int cutOff, int broken) {
    Runouts runouts;
    for (int i = 0; i < 1000; ++i) {
      RockRecord rock;
      rock.end = {100 + 0.01 * i, 0, 0};
      rock.ending = i < cutOff ? (i % 2 ? RockEnd::left : RockEnd::moving) : RockEnd::resting;
      runouts.add(rock);
    }
    for (int i = 0; i < broken; ++i) {
      RockRecord rock;
      rock.ending = RockEnd::broken;
      runouts.add(rock);
    }
    return checkQuantiles(runouts, {}, 1000).at(0);
  };
  EXPECT_TRUE(checkOf(50, 0).isEnough(1000));
  EXPECT_FALSE(checkOf(51, 0).isEnough(1000));
  EXPECT_NE(enoughText({checkOf(51, 0)}, 1000).find("51 of 1000 rocks left the map or still moved"), std::string::npos);
  EXPECT_EQ(checkOf(0, 400).values, 1000U) << "a rock that broke has no run-out of its own";
}

}  // namespace
}  // namespace cairn::rockfall::sample_test
