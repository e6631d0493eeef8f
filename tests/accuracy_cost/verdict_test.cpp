// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "accuracy_cost/experiments/experiment.h"
#include "accuracy_cost/experiments/fit_columns.h"
#include "accuracy_cost/experiments/thesis_ratios.h"
#include "accuracy_cost/figures/gnuplot_script.h"

namespace cairn::accuracy_cost::verdict_test {
namespace {

Claim claim(bool holds) {
  return {"thesis", "rule", "found", holds};
}

TEST(Verdict, FollowsItsRule) {
  EXPECT_EQ(verdictOf({claim(true), claim(true)}), Verdict::reproduced);
  EXPECT_EQ(verdictOf({claim(true), claim(false)}), Verdict::inPart);
  EXPECT_EQ(verdictOf({claim(false)}), Verdict::notReproduced);
  EXPECT_EQ(verdictOf({}), Verdict::notReproduced) << "nothing was found";
  EXPECT_EQ(whyText({claim(true), claim(false)}), "1 of 2 claims hold. Not: thesis (rule: rule).");
}

TEST(Verdict, IsInPartWhereAModelThatIsNamedWasNotMeasured) {
  Claim partial = claim(true);
  partial.lacking = {"dragon"};
  EXPECT_EQ(verdictOf({claim(true), partial}), Verdict::inPart);
  EXPECT_EQ(whyText({claim(true), partial}),
            "1 of 2 claims hold. In part: thesis; only 0 of 1 models measured (without dragon).");
  partial.holds = false;
  partial.scope.reach = Reach::every;
  EXPECT_EQ(verdictOf({partial}), Verdict::notReproduced) << "one is enough to refute what is said of all";
}

TEST(Verdict, IsNotDecidedByFewerModelsThanAClaimIsAbout) {
  const auto standing = [](Reach reach, bool holds) {
    Claim partial = claim(holds);
    partial.scope.reach = reach;
    return standingOf(withLacking({partial}, {"bunny", "cow", "dragon"}, {"bunny"}).front());
  };
  EXPECT_EQ(standing(Reach::every, true), Standing::inPart);
  EXPECT_EQ(standing(Reach::every, false), Standing::fails);
  EXPECT_EQ(standing(Reach::some, true), Standing::holds);
  EXPECT_EQ(standing(Reach::some, false), Standing::undecided);
  EXPECT_EQ(standing(Reach::share, true), Standing::inPart);
  EXPECT_EQ(standing(Reach::share, false), Standing::undecided);
  const auto told = withLacking({claim(false)}, {"bunny", "cow", "dragon"}, {"bunny"});
  EXPECT_EQ(verdictOf(told), Verdict::undecided);
  EXPECT_EQ(lackingText(told.front()), "only 1 of 3 models measured (without cow, dragon)");
  EXPECT_EQ(whyText(told), "0 of 1 claims hold. Not decided: thesis; " + lackingText(told.front()) + ".");
}

TEST(Verdict, IsNotDecidedWithoutAMethodAClaimIsAbout) {
  Claim partial = claim(false);
  partial.scope.lackingSettings = {"method burst"};
  EXPECT_EQ(standingOf(partial), Standing::undecided);
  partial.holds = true;
  EXPECT_EQ(standingOf(partial), Standing::inPart);
  partial.scope.settingReach = Reach::some;
  EXPECT_EQ(standingOf(partial), Standing::holds);
  EXPECT_EQ(lackingText(partial), "not measured: method burst");
}

TEST(Verdict, OfOurOwnReproducesNothingAndDoesNotCountBesideTheThesiss) {
  Claim own = claim(false);
  own.isOwn = true;
  EXPECT_EQ(verdictOf({claim(true), own}), Verdict::reproduced);
  EXPECT_STREQ(verdictName(verdictOf({own}), true), "does not hold");
  EXPECT_TRUE(findExperiment("frame-time")->isOwn);
  EXPECT_TRUE(findExperiment("error-against-time")->isOwn);
}

builder::LevelFit fitOf(double error, double variance = 0, double uncovered = 0) {
  builder::LevelFit fit;
  fit.sampledMaxFraction = fit.sampledRmsFraction = fit.sampledMeanFraction = fit.wastedVolumeFraction = error;
  fit.sampledVarianceFractionSquared = variance;
  fit.uncoveredAreaFraction = uncovered;
  return fit;
}

std::string verdictIn(const char* experiment, const Table& table) {
  return verdictName(verdictOf(findExperiment(experiment)->judge(table)));
}

/// Samples, spheres and fit of both samplings; the adaptive one `better` times as good.
Table samplingTable(double better) {
  Table table(withFitColumns({"model", "sampling", "samples", "spheres", "coverage_spheres"}));
  for (const int samples : {500, 1000, 2000}) {
    const double error = 10.0 / samples;
    table.addRow(withFit({"cube", "regular", fmt::format("{}", samples), fmt::format("{}", 3 * samples), "0"},
                         fitOf(error, error, 0.05)));
    table.addRow(withFit({"cube", "adaptive", fmt::format("{}", samples), fmt::format("{}", 3 * samples), "0"},
                         fitOf(error / better, error / better, better > 1 ? 0 : 0.1)));
  }
  return table;
}

TEST(Verdict, OfSamplingTurnsWithTheData) {
  EXPECT_EQ(verdictIn("sampling", samplingTable(2)), "reproduced");
  EXPECT_EQ(verdictIn("sampling", samplingTable(0.5)), "reproduced in part") << "spheres still grow linearly";
}

Table reductionTable(double hubbard, double merge, double expand, double burst) {
  Table table(withFitColumns({"model", "algorithm", "asked", "spheres", "complete"}));
  for (const char* asked : {"8", "16"}) {
    table.addRow(withFit({"cone", "hubbard", asked, asked, "yes"}, fitOf(hubbard, 1e-2)));
    table.addRow(withFit({"cone", "merge", asked, asked, "yes"}, fitOf(merge, 1e-3)));
    table.addRow(withFit({"cone", "expand", asked, asked, "yes"}, fitOf(expand, 1e-8)));
    table.addRow(withFit({"cone", "burst", asked, asked, "yes"}, fitOf(burst, 1e-3)));
  }
  return table;
}

TEST(Verdict, OfReductionsTurnsWithTheData) {
  EXPECT_EQ(verdictIn("reductions", reductionTable(4, 3, 2, 1)), "reproduced");
  EXPECT_EQ(verdictIn("reductions", reductionTable(1, 2, 3, 4)), "reproduced in part") << "variances are as before";
}

TEST(Verdict, OfReductionsLeavesOutSetsThatAreTooSmall) {
  Table table = reductionTable(4, 3, 2, 1);
  table.addRow(withFit({"cone", "expand", "64", "20", "no"}, fitOf(100)));
  table.addRow(withFit({"cone", "merge", "64", "64", "yes"}, fitOf(1)));
  EXPECT_EQ(verdictIn("reductions", table), "reproduced");
}

/// Trees whose ratios are the thesis's, times a factor.
Table levelTable(double factor) {
  Table table(withFitColumns({"model", "construction", "level", "spheres"}));
  for (const ThesisRatio& r : thesisRatios()) {
    const auto level = fmt::format("{}", r.level);
    if (table.select({{"model", r.model}, {"construction", r.first}, {"level", level}}).empty())
      table.addRow(withFit({r.model, r.first, level, "8"}, fitOf(0.1 / r.level)));
    builder::LevelFit fit = fitOf(0);
    fit.sampledMaxFraction = 0.1 / r.level / (r.max * factor);
    fit.sampledRmsFraction = 0.1 / r.level / (r.rms * factor);
    table.addRow(withFit({r.model, r.second, level, "8"}, fit));
    // The thesis's own grid has the smallest spheres; ours of that name moves them.
    if (r.second == std::string("grid")) table.addRow(withFit({r.model, "grid-volume", level, "8"}, fit));
  }
  return table;
}

TEST(Verdict, OfLevelsIsReproducedByTheThesissOwnFigures) {
  EXPECT_EQ(verdictIn("levels", levelTable(1)), "reproduced");
  EXPECT_EQ(verdictIn("levels", levelTable(0.02)), "not reproduced");
  ASSERT_EQ(thesisRatios().size(), 60U) << "four tables of five ratios at three levels";
}

/// Max-elim needs `elim` times the spheres at the first `apart` stand-offs, and hardly more or as hardly fewer at
/// others.
Table selectionTable(double elim, int apart = 65) {
  Table table({"model", "heuristic", "search", "stand_off_fraction", "spheres"});
  for (int i = 0; i < 65; ++i) {
    table.add("bunny", "max-cover", "spheres at a stand-off", 0.1 + i, 100 - i);
    table.add("bunny", "max-elim", "spheres at a stand-off", 0.1 + i, (i < apart ? elim : 1 / elim) * (100 - i));
  }
  table.add("bunny", "max-cover", "least stand-off", 0.1, 8);
  table.add("bunny", "max-elim", "least stand-off", 0.1 * elim, 8);
  return table;
}

TEST(Verdict, OfExpandSelectionLeavesTheTorusApart) {
  Table table = selectionTable(0.98, 35);
  for (int i = 0; i < 65; ++i) {
    table.add("torus", "max-cover", "spheres at a stand-off", 0.1 + i, 100 - i);
    table.add("torus", "max-elim", "spheres at a stand-off", 0.1 + i, 0.5 * (100 - i));
  }
  EXPECT_EQ(verdictIn("expand-selection", table), "reproduced") << "significant there, as in the thesis";
}

TEST(Verdict, OfExpandSelectionTurnsWithTheData) {
  EXPECT_EQ(verdictIn("expand-selection", selectionTable(0.98, 35)), "reproduced");
  const auto claims = findExperiment("expand-selection")->judge(selectionTable(0.98));
  EXPECT_TRUE(claims[0].holds) << "independent groups do not tell them apart";
  EXPECT_FALSE(claims[1].holds) << "pair by pair one is always the lower: " << claims[1].found;
  EXPECT_EQ(verdictIn("expand-selection", selectionTable(1.02)), "reproduced in part") << "not significantly different";
  EXPECT_EQ(verdictIn("expand-selection", selectionTable(2)), "not reproduced");
}

Table balanceTable(const char* spheres, double error) {
  Table table(withFitColumns({"model", "method", "allowance", "level", "spheres"}));
  for (const char* method : {"merge", "expand", "combined"}) {
    table.addRow(withFit({"bunny", method, "as made", "3", "500"}, fitOf(1)));
    for (const char* allowance : {"100 %", "105 %"})
      table.addRow(withFit({"bunny", method, allowance, "3", spheres}, fitOf(error)));
  }
  return table;
}

TEST(Verdict, OfBalanceTurnsWithTheData) {
  EXPECT_EQ(verdictIn("balance", balanceTable("300", 1.05)), "reproduced");
  EXPECT_EQ(verdictIn("balance", balanceTable("450", 1.05)), "reproduced in part");
  EXPECT_EQ(verdictIn("balance", balanceTable("500", 2)), "not reproduced");
}

TEST(Verdict, OfExpandSelectionTakesTiesForNothing) {
  const auto claims = findExperiment("expand-selection")->judge(selectionTable(1));
  EXPECT_FALSE(claims[2].holds);
  EXPECT_FALSE(claims[3].holds);
  EXPECT_NE(claims[3].found.find("lower in 0 cases, the same in 1, higher in 0"), std::string::npos) << claims[3].found;
}

TEST(Experiments, HaveNamesOfTheirOwnAndFiguresNamedAfterThem) {
  std::set<std::string> names, known;
  for (const std::string& model : modelNames()) known.insert(model);
  for (const Experiment& e : allExperiments()) {
    EXPECT_TRUE(names.insert(e.name).second) << e.name;
    for (const auto* list : {&e.models, &e.quickModels})
      for (const std::string& model : *list) EXPECT_TRUE(known.contains(model)) << model;
  }
  EXPECT_EQ(findExperiment("no such"), nullptr);
  const Table table = samplingTable(2);
  const auto figures = findExperiment("sampling")->draw(table);
  ASSERT_FALSE(figures.empty());
  EXPECT_EQ(figures.front().name, "sampling");
  const std::string script = gnuplotScript(figures.front(), table, "it's.csv", PictureFormat::svg, "a.svg");
  EXPECT_NE(script.find("'it''s.csv'"), std::string::npos) << "quotes of a path are doubled";
}

}  // namespace
}  // namespace cairn::accuracy_cost::verdict_test
