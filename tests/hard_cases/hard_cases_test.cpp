// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "dynamics/compare.h"
#include "table/known_misses.h"
#include "table/print.h"
#include "table/verdict.h"

namespace cairn::hard {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

Measure twiceAsBad(Measure measure) {
  measure.value *= measure.bound == Bound::atMost ? 2 : 0.5;
  return measure;
}

class HardCases : public testing::TestWithParam<HardCase> {};

TEST_P(HardCases, HoldsButForKnownMisses) {
  const Outcome outcome = GetParam().run(Effort::quick);
  const std::string lines = linesOf(GetParam(), outcome, 0);
  ASSERT_FALSE(outcome.measures.empty());
  for (const Measure& measure : outcome.measures) {
    EXPECT_TRUE(std::isfinite(measure.value)) << measure.name << "\n" << lines;
    EXPECT_FALSE(isNews(GetParam().id, measure, Effort::quick)) << measure.name << "\n" << lines;
  }
  for (const std::string& known : knownMisses(GetParam().id, Effort::quick)) {
    const auto measure = std::ranges::find(outcome.measures, known, &Measure::name);
    ASSERT_NE(measure, outcome.measures.end()) << known << " is not measured\n" << lines;
    EXPECT_NE(verdictOn(*measure), Verdict::holds) << known << " holds now\n" << lines;
    EXPECT_TRUE(isNews(GetParam().id, twiceAsBad(*measure), Effort::quick)) << known << " may double unseen\n" << lines;
  }
  for (const std::string& known : knownMisses(GetParam().id, Effort::whole))
    EXPECT_NE(std::ranges::find(outcome.measures, known, &Measure::name), outcome.measures.end())
        << known << " is not measured\n"
        << lines;
  if (verdictOn(outcome) == Verdict::misses) EXPECT_FALSE(outcome.why.empty()) << lines;
}

INSTANTIATE_TEST_SUITE_P(All, HardCases, testing::ValuesIn(allHardCases()),
                         [](const auto& each) { return each.param.id; });

TEST(HardCaseTable, HasEveryCaseOnce) {
  std::set<std::string> ids;
  for (const HardCase& hardCase : allHardCases()) EXPECT_TRUE(ids.insert(hardCase.id).second) << hardCase.id;
}

TEST(KnownMisses, AreNewsWhereTheyBecomeWorse) {
  Measure measure{"deepest penetration", 26, 10, Bound::atMost, "", "hull", 23};
  EXPECT_FALSE(isNews("D11", measure, Effort::whole));
  EXPECT_TRUE(isNews("D11", measure, Effort::quick)) << "a quick pit is shallower";
  EXPECT_TRUE(isNews("D12", measure, Effort::whole)) << "of another case";
  measure.value = 50;
  EXPECT_TRUE(isNews("D11", measure, Effort::whole));
  measure.value = kNan;
  EXPECT_TRUE(isNews("D11", measure, Effort::whole));
  measure.value = 50;
  measure.stockValue = 60;
  EXPECT_TRUE(isNews("D11", measure, Effort::whole)) << "a hull that is worse still is no excuse";
  EXPECT_FALSE(isNews("D12", measure, Effort::whole)) << "as good as stock, and no known miss";
  measure.value = 9;
  EXPECT_FALSE(isNews("D12", measure, Effort::whole)) << "it holds";
  const Measure stands{"a card house of 7 cards stands, mean", 7.2, 10, Bound::atLeast, "", "gimpact", 8.3};
  EXPECT_FALSE(isNews("D3", stands, Effort::whole));
  Measure falls = stands;
  falls.value = 2;
  EXPECT_TRUE(isNews("D3", falls, Effort::whole));
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

TEST(Verdict, TellsWhereAShapeOfBulletsIsBetterThanWhatHolds) {
  EXPECT_TRUE(holdsBehindStock(Measure{"", 1, 2, Bound::atMost, "", "hull", 0.5}));
  EXPECT_TRUE(holdsBehindStock(Measure{"", 3, 2, Bound::atLeast, "", "hull", 4}));
  EXPECT_FALSE(holdsBehindStock(Measure{"", 1, 2, Bound::atMost, "", "hull", 1}));
  EXPECT_FALSE(holdsBehindStock(Measure{"", 1, 2, Bound::atMost, "", "", 0}));
  EXPECT_FALSE(holdsBehindStock(Measure{"", 3, 2, Bound::atMost, "", "hull", 1})) << "it misses";
}

TEST(Verdict, NanMisses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdictOn(Measure{"", nan, 1, Bound::atMost, "", "hull", 2}), Verdict::misses);
  EXPECT_EQ(verdictOn(Outcome{}), Verdict::misses);
}

TEST(Quantile, IsTowardsTheWorse) {
  const std::vector<double> values{4, 1, 3, 2, 5, 6, 7, 8, 9, 10};
  EXPECT_EQ(quantileOf(values, 0.5, Bound::atMost), 6);
  EXPECT_EQ(quantileOf(values, 0.5, Bound::atLeast), 5);
  EXPECT_EQ(quantileOf(values, 0.9, Bound::atMost), 10);
  EXPECT_EQ(quantileOf(values, 1, Bound::atMost), 10);
  EXPECT_EQ(quantileOf(values, 1, Bound::atLeast), 1);
  EXPECT_EQ(quantileOf({3}, 0.5, Bound::atMost), 3);
}

TEST(Quantile, OfNanIsNan) {
  EXPECT_TRUE(std::isnan(quantileOf({1, kNan, 2}, 0.5, Bound::atMost)));
  EXPECT_TRUE(std::isnan(quantileOf({1, 2, kInfinity}, 0.5, Bound::atMost)));
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
  EXPECT_EQ(measures[1].stock, "hull") << "NaN is nobody's best";
}

}  // namespace
}  // namespace cairn::hard
