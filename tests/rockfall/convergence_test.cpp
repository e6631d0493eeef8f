// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/convergence/convergence.h"
#include "rockfall/convergence/convergence_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <vector>

#include "prepared_scene.h"
#include "rockfall/convergence/paired_runs.h"

namespace cairn::rockfall::convergence_test {
namespace {

using nlohmann::json;

// Pairs of known differences: the interval holds the true one as often as it says.
TEST(StepDifference, HoldsTheTrueDifferenceAsOftenAsItSays) {
  constexpr std::uint32_t kSeed = 5;
  constexpr double kTrue = -0.02, kScatter = 0.1;
  constexpr int kTimes = 300;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  std::normal_distribution<double> noise(0, kScatter);
  int holds = 0;
  for (int time = 0; time < kTimes; ++time) {
    std::vector<PairedSums> runs(20);
    for (PairedSums& run : runs) run = {100 * (1 + kTrue + noise(random)), 100};
    const StepDifference d = differenceOf(runs, static_cast<std::uint64_t>(time));
    ASSERT_LE(d.low, d.mean);
    ASSERT_LE(d.mean, d.high);
    holds += d.low <= kTrue && kTrue <= d.high;
  }
  // Of 20 runs the bootstrap is a little too sure: 92 to 95 in a hundred; three standard errors are 4 in a hundred.
  EXPECT_GT(holds, kTimes * 0.88);
  EXPECT_LT(holds, kTimes * 0.99);
}

TEST(StepDifference, IsTheSameForTheSameSeedAndNothingForEqualRuns) {
  const std::vector<PairedSums> runs{{1, 2}, {3, 2}, {2, 2}, {4, 5}, {1, 1}};
  const StepDifference a = differenceOf(runs, 9), b = differenceOf(runs, 9);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  const std::vector<PairedSums> equal(6, PairedSums{3, 3});
  EXPECT_EQ(differenceOf(equal, 1).low, 0);
  EXPECT_EQ(differenceOf(equal, 1).high, 0);
  EXPECT_EQ(differenceOf(std::vector<PairedSums>(6, PairedSums{0, 0}), 1).mean, 0) << "nothing moved";
}

TEST(StepVerdict, GoesByTheWholeInterval) {
  EXPECT_EQ(verdictOf({0, -0.02, 0.02}, 0.03), StepVerdict::fine);
  EXPECT_EQ(verdictOf({0, -0.04, 0.02}, 0.03), StepVerdict::undecided);
  EXPECT_EQ(verdictOf({-0.06, -0.08, -0.04}, 0.03), StepVerdict::coarse);
  EXPECT_EQ(verdictOf({0.06, 0.04, 0.08}, 0.03), StepVerdict::coarse);
  EXPECT_EQ(runsWanted({0, -0.06, 0.06}, 0.03, 20), 80U) << "half the width takes four times the runs";
  EXPECT_EQ(runsWanted({0.03, -0.06, 0.12}, 0.03, 20), 0U) << "no number tells what lies on the tolerance";
}

json fallingCase() {
  json document = test::plainCase();
  document["rocks"][0]["count"] = 3;
  document["rocks"][0]["tree_depth"] = 1;
  document["duration_s"] = 1;
  document["step_s"] = 0.02;
  return document;
}

// Nothing is touched: a fall of one second, whose speed semi-implicit steps give exactly.
TEST(Convergence, FindsEveryStepFineWhereTheStepDecidesNothing) {
  json document = fallingCase();
  document["rocks"][0]["release"]["above_ground_m"] = 100;
  document["rocks"][0]["release"]["velocity_m_per_s"] = {3, 0, 0};
  Scene scene = test::prepared(document);
  const auto found = converge(scene, {.runs = {0, 5}, .halvings = 2});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found.value().steps.size(), 3U);
  EXPECT_EQ(found.value().rocks, 15U);
  EXPECT_EQ(found.value().cutOff, 15U) << "all still fall";
  EXPECT_FALSE(found.value().judgesRunouts());
  const std::string told = convergenceText(found.value(), scene.description, 0.03);
  EXPECT_NE(told.find("15 of 15 rocks left the map or still moved at the end"), std::string::npos) << told;
  EXPECT_NE(told.find("the means of speed and energy are within"), std::string::npos) << told;
  EXPECT_EQ(found.value().steps[0].verdict, StepVerdict::fine);
  EXPECT_EQ(found.value().steps[2].verdict, StepVerdict::reference);
  EXPECT_EQ(found.value().fineStepS, 0.02);
  EXPECT_EQ(scene.description.stepS, 0.02) << "the scene has its step again";
}

// A rock that lies moves by rounding only; air so thick that a step of 20 ms is most of its fall's time is another
// thing: gravity and drag take turns, and what falls gets half a step's gravity too much.
TEST(Convergence, FindsTheStepTooCoarseWhereItDecides) {
  json document = fallingCase();
  document["rocks"][0]["release"]["above_ground_m"] = 100;
  document["effects"] = json::array({{{"effect", "air_drag"}, {"density_kg_per_m3", 20000.0}, {"coefficient", 10}}});
  document["step_s"] = 0.1;
  Scene scene = test::prepared(document);
  const auto found = converge(scene, {.runs = {0, 5}, .halvings = 2});
  if (!found) GTEST_FAIL() << found.error().message;
  EXPECT_EQ(found.value().steps[0].verdict, StepVerdict::coarse);
  EXPECT_FALSE(found.value().fineStepS == 0.1);
}

TEST(Convergence, IsTheSameForAnyNumberOfProcesses) {
  const auto differencesWith = [](std::uint32_t jobs) {
    Scene scene = test::prepared(fallingCase());
    auto found = converge(scene, {.runs = {0, 6}, .halvings = 1, .jobs = jobs});
    EXPECT_TRUE(found);
    const ConvergenceStep& step = found.value().steps[0];
    return std::vector{step.means[0], step.means[1], step.differences[0].low, step.differences[2].high};
  };
  EXPECT_EQ(differencesWith(1), differencesWith(3));
}

TEST(Convergence, RefusesWhatItCannotCompare) {
  const auto complaint = [](const json& document, const ConvergenceOptions& options) {
    const auto description = test::readJson(document);
    const Status checked = checkConvergence(description.value(), options);
    return checked ? std::string() : checked.error().message;
  };
  const ConvergenceOptions plenty{.runs = {0, 20}};
  EXPECT_EQ(complaint(fallingCase(), plenty), "");
  json onTime = fallingCase();
  onTime["budget"]["microseconds"] = 100;
  EXPECT_NE(complaint(onTime, plenty).find("/budget/microseconds"), std::string::npos);
  EXPECT_NE(complaint(fallingCase(), {.runs = {0, 4}}).find("at least 5"), std::string::npos);
  json shortest = fallingCase();
  shortest["step_s"] = 2e-5;
  EXPECT_NE(complaint(shortest, plenty).find("/step_s"), std::string::npos);
}

TEST(ConvergeCommand, PrintsTheAnswerAndItsTwin) {
  const test::TemporaryFolder folder;
  json document = fallingCase();
  document["rocks"][0]["release"]["above_ground_m"] = 100;
  document["rocks"][0]["release"]["velocity_m_per_s"] = {3, 0, 0};
  const auto file = folder.path() / "fall.json", told = folder.path() / "told.json";
  std::ofstream(file) << document.dump();
  const std::string arguments = "converge '" + file.string() + "' --runs 0:5 --halvings 1 --cache '" +
                                test::treeFolder().string() + "' --json '" + told.string() + "'";
  const test::ProgramResult result = test::runProgram("rockfall", arguments);
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_NE(result.output.find("a step of 20 ms is fine enough"), std::string::npos) << result.output;
  const json twin = json::parse(test::contentOf(told));
  EXPECT_EQ(twin.at("fine_step_s"), 0.02);
  EXPECT_EQ(twin.at("steps").size(), 2U);
  EXPECT_NEAR(twin.at("steps").at(1).at("mean_runout_m").get<double>(), 3, 1e-3) << "3 m/s for a second";
  EXPECT_NEAR(twin.at("steps").at(0).at("mean_max_speed_m_per_s").get<double>(), std::hypot(3, 9.81), 1e-3);
  const test::ProgramResult few = test::runProgram("rockfall", "converge '" + file.string() + "' --runs 0:2");
  EXPECT_EQ(few.exitCode, 1);
  EXPECT_NE(few.errors.find("at least 5"), std::string::npos) << few.errors;
}

}  // namespace
}  // namespace cairn::rockfall::convergence_test
