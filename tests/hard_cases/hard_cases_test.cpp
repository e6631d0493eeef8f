// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "table/print.h"
#include "table/verdict.h"

namespace cairn::hard {
namespace {

class HardCases : public testing::TestWithParam<HardCase> {};

// Misses of quick runs that docs/hard-cases.md tells of. Any other is news, and so is one of these that holds.
const std::set<std::string>& knownMisses() {
  static const std::set<std::string> misses{"D11", "L1"};
  return misses;
}

TEST_P(HardCases, HoldsButForKnownMisses) {
  const Outcome outcome = GetParam().run(Effort::quick);
  const std::string lines = linesOf(GetParam(), outcome, 0);
  for (const Measure& measure : outcome.measures)
    EXPECT_TRUE(std::isfinite(measure.value)) << measure.name << "\n" << lines;
  EXPECT_EQ(verdictOn(outcome) == Verdict::misses, knownMisses().contains(GetParam().id)) << lines;
  if (verdictOn(outcome) == Verdict::misses) EXPECT_FALSE(outcome.why.empty()) << lines;
}

INSTANTIATE_TEST_SUITE_P(All, HardCases, testing::ValuesIn(allHardCases()),
                         [](const auto& each) { return each.param.id; });

TEST(HardCaseTable, HasEveryCaseOnce) {
  std::set<std::string> ids;
  for (const HardCase& hardCase : allHardCases()) EXPECT_TRUE(ids.insert(hardCase.id).second) << hardCase.id;
}

TEST(Verdict, WithinTheLimitHolds) {
  EXPECT_EQ(verdictOn(Measure{"", 1, 1, Bound::atMost, "", "", 0}), Verdict::holds);
  EXPECT_EQ(verdictOn(Measure{"", 1, 1, Bound::atLeast, "", "", 0}), Verdict::holds);
}

TEST(Verdict, BeyondItMissesUnlessBulletsShapesDoNoBetter) {
  EXPECT_EQ(verdictOn(Measure{"", 2, 1, Bound::atMost, "", "", 0}), Verdict::misses);
  EXPECT_EQ(verdictOn(Measure{"", 2, 1, Bound::atMost, "", "hull", 1.5}), Verdict::misses);
  EXPECT_EQ(verdictOn(Measure{"", 2, 1, Bound::atMost, "", "hull", 2}), Verdict::asGoodAsStock);
  EXPECT_EQ(verdictOn(Measure{"", 0, 1, Bound::atLeast, "", "hull", 0.5}), Verdict::misses);
}

TEST(Verdict, WhatIsNoNumberMisses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdictOn(Measure{"", nan, 1, Bound::atMost, "", "hull", 2}), Verdict::misses);
  EXPECT_EQ(verdictOn(Outcome{}), Verdict::misses);
}

}  // namespace
}  // namespace cairn::hard
