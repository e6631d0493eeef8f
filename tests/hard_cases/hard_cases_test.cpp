// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "dynamics/compare.h"
#include "table/print.h"
#include "table/verdict.h"

namespace cairn::hard {
namespace {

class HardCases : public testing::TestWithParam<HardCase> {};

// Misses of quick runs that docs/hard-cases.md tells of, by measure. Any other is news, and so is one of these that
// holds.
const std::set<std::string>& knownMisses(const std::string& id) {
  static const std::string fixed = ", friction along a fixed direction", both = ", friction in two directions",
                           place = "place, RMS about its mean", tenth = "drift, upper tenth";
  static const std::map<std::string, std::set<std::string>> misses{
      // Of three rocks in seconds; whole minutes of forty go the other way half of the time.
      {"D1", {tenth, place + fixed, "drift" + fixed, place + both, "drift" + both, tenth + both}},
      {"D11", {"deepest penetration"}},
      {"L1", {"drift, median" + both}}};
  static const std::set<std::string> none;
  const auto known = misses.find(id);
  return known == misses.end() ? none : known->second;
}

TEST_P(HardCases, HoldsButForKnownMisses) {
  const Outcome outcome = GetParam().run(Effort::quick);
  const std::string lines = linesOf(GetParam(), outcome, 0);
  ASSERT_FALSE(outcome.measures.empty());
  for (const Measure& measure : outcome.measures) {
    EXPECT_TRUE(std::isfinite(measure.value)) << measure.name << "\n" << lines;
    EXPECT_EQ(verdictOn(measure) == Verdict::misses, knownMisses(GetParam().id).contains(measure.name))
        << measure.name << "\n"
        << lines;
  }
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

const double kNan = std::numeric_limits<double>::quiet_NaN(), kEndless = std::numeric_limits<double>::infinity();

TEST(Quantile, IsTowardsTheWorse) {
  const std::vector<double> values{4, 1, 3, 2, 5, 6, 7, 8, 9, 10};
  EXPECT_EQ(quantileOf(values, 0.5, Bound::atMost), 6);
  EXPECT_EQ(quantileOf(values, 0.5, Bound::atLeast), 5);
  EXPECT_EQ(quantileOf(values, 0.9, Bound::atMost), 10);
  EXPECT_EQ(quantileOf(values, 1, Bound::atMost), 10);
  EXPECT_EQ(quantileOf(values, 1, Bound::atLeast), 1);
  EXPECT_EQ(quantileOf({3}, 0.5, Bound::atMost), 3);
}

TEST(Quantile, OfWhatIsNoNumberIsNone) {
  EXPECT_TRUE(std::isnan(quantileOf({1, kNan, 2}, 0.5, Bound::atMost)));
  EXPECT_TRUE(std::isnan(quantileOf({1, 2, kEndless}, 0.5, Bound::atMost)));
  EXPECT_TRUE(std::isnan(quantileOf({}, 0.5, Bound::atMost)));
}

TEST(Worst, IsOfEachFigureByItself) {
  const std::vector<Asked> asked{{"", 0, Bound::atMost, ""}, {"", 0, Bound::atLeast, ""}};
  EXPECT_EQ(worstOf(asked, {{1, 2}, {3, 4}}), (Figures{3, 2}));
  EXPECT_TRUE(std::isnan(worstOf(asked, {{1, 2}, {kNan, 4}, {5, 6}}).front()));
}

TEST(ComparedSeeds, AreJoinedAsAskedAndBesideTheBest) {
  const std::vector<Asked> asked{{"median", 0, Bound::atMost, ""}, {"worst", 0, Bound::atMost, "", 1}};
  const CaseBodies bodies{{"tree", {}}, {"hull", {}}, {"sphere", {}}};
  const auto run = [](const CaseBody& body, std::uint64_t seed) -> Figures {
    const double ours = double(seed * seed);
    if (body.name == "tree") return {ours, ours};
    return body.name == "hull" ? Figures{2 * ours, 2 * ours} : Figures{3 * ours, seed == 2 ? kNan : 1};
  };
  const auto measures = compareSeeds(
      asked, 3, [&](std::uint64_t) -> const CaseBodies& { return bodies; }, run);
  ASSERT_EQ(measures.size(), 2u);
  EXPECT_EQ(measures[0].value, 4);
  EXPECT_EQ(measures[1].value, 9);
  EXPECT_EQ(measures[0].stock, "hull");
  EXPECT_EQ(measures[0].stockValue, 8);
  EXPECT_EQ(measures[1].stock, "hull") << "a figure that is no number is nobody's best";
}

}  // namespace
}  // namespace cairn::hard
