// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "accuracy_cost/figures/draw.h"
#include "accuracy_cost/models/solids.h"
#include "cairn/builder/simplify.h"
#include "cairn/core/atomic_file.h"
#include "interrupted_program.h"
#include "run_program.h"

namespace cairn::advise::program_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::contentOf;
using test::ProgramResult;

/// `cairn advise` on a ring of a few triangles, so that it takes seconds.
class AdviseProgram : public ::testing::Test {
 protected:
  AdviseProgram() {
    EXPECT_TRUE(writeFileAtomically(path("ring.obj"), builder::objText(accuracy_cost::torus(1, 0.35, 16, 8))));
  }

  fs::path path(const std::string& name) const { return temporary_.path() / name; }
  std::string quoted(const std::string& name) const { return "'" + path(name).string() + "'"; }
  ProgramResult run(const std::string& rest) const {
    return test::runProgram("cairn", "advise " + quoted("ring.obj") + " --methods combined,octree --depths 1,2 " +
                                         "--bodies 8 --frames 200 --repeats 1 " + rest);
  }
  ProgramResult runJson(const std::string& file, const std::string& rest) const {
    return run("--json " + quoted(file) + " " + rest);
  }
  json read(const std::string& file) const { return json::parse(contentOf(path(file))); }

  test::TemporaryFolder temporary_;
};

TEST_F(AdviseProgram, RecommendsWhatItsTableSays) {
  const ProgramResult result = runJson("advice.json", "--budget-us 1e6 --all");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const json document = read("advice.json");
  ASSERT_EQ(document["trees"].size(), 6U) << "octree has one branching";
  double least = 1;
  std::size_t budgets = 0;
  for (const json& tree : document["trees"]) {
    EXPECT_FALSE(tree["budgets"].back()["cuts"]);
    for (const json& rung : tree["budgets"]) {
      EXPECT_TRUE(rung["fits"]);
      EXPECT_GE(rung["certified_error_worst_fraction"], rung["certified_error_mean_fraction"]);
      least = std::min(least, rung["certified_error_mean_fraction"].get<double>());
      ++budgets;
    }
  }
  const json& chosen = document["recommendation"];
  EXPECT_EQ(chosen["certified_error_mean_fraction"], least);
  EXPECT_NE(result.output.find(document["advice"].get<std::string>()), std::string::npos);
  const bool isBound = !chosen["budget_operations"].is_null();
  const std::string budget =
      isBound ? std::to_string(chosen["budget_operations"].get<std::uint64_t>()) : std::string("none");
  EXPECT_NE(document["advice"].get<std::string>().find(isBound ? "set the budget to " + budget
                                                               : std::string("set no budget of operations")),
            std::string::npos);

  std::istringstream lines(result.output);
  std::size_t rows = 0, arrows = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool isRow = line.size() > 40 && (line.find("combined  ") == 3 || line.find("octree  ") == 3);
    rows += isRow ? 1 : 0;
    if (!isRow || line.rfind("->", 0) != 0) continue;
    ++arrows;
    EXPECT_NE(line.find(chosen["method"].get<std::string>()), std::string::npos) << line;
    EXPECT_NE(line.find(" " + budget + " "), std::string::npos) << line;
  }
  EXPECT_EQ(rows, budgets);
  EXPECT_EQ(arrows, 1U);
  for (const char* heading : {"method", "branching", "depth", "spheres", "build s", "certified error", "p99"})
    EXPECT_NE(result.output.find(heading), std::string::npos) << heading;
}

TEST_F(AdviseProgram, ErrorsAndOperationsAreTheSameOnEveryRun) {
  ASSERT_EQ(runJson("one.json", "--budget-us 100 --threads 1").exitCode, 0);
  ASSERT_EQ(runJson("two.json", "--budget-us 100 --threads 2").exitCode, 0);
  json one = read("one.json"), two = read("two.json");
  EXPECT_EQ(one["recording_hash"], two["recording_hash"]);
  EXPECT_GT(one["busy_frames"], 0);
  for (json* document : {&one, &two})
    for (json& tree : (*document)["trees"]) {
      for (const char* time : {"build_wall_s", "playings"}) tree.erase(time);
      for (json& rung : tree["budgets"])
        for (const char* time : {"narrow_phase_median_us", "narrow_phase_p99_us", "narrow_phase_p99_quickest_start_us",
                                 "narrow_phase_p99_slowest_start_us", "fits"})
          rung.erase(time);
    }
  EXPECT_EQ(one["trees"], two["trees"]);
}

TEST_F(AdviseProgram, LooksAtTheSameFramesInWhateverOrderTreesAreNamed) {
  const auto frames = [&](const std::string& file, const std::string& depths) {
    const ProgramResult result =
        test::runProgram("cairn", "advise " + quoted("ring.obj") + " --methods octree --depths " + depths +
                                      " --bodies 8 --frames 200 --repeats 1 --budget-us 5 --json " + quoted(file));
    EXPECT_EQ(result.exitCode, 0) << result.output;
    return read(file)["busy_frames"];
  };
  EXPECT_EQ(frames("up.json", "1,3"), frames("down.json", "3,1"));
}

// Its advice on a budget agrees with that budget's effect in another program: of one that cuts, of one that does not,
// and of none.
TEST_F(AdviseProgram, ItsBudgetsDoWhatItSays) {
  const std::string common = " --bodies 8 --seed 1 ";
  const ProgramResult advised =
      test::runProgram("cairn", "advise " + quoted("ring.obj") + common +
                                    "--methods combined --branching 8 --depths 2 --frames 200 --budget-us 1e6 --json " +
                                    quoted("advice.json"));
  ASSERT_EQ(advised.exitCode, 0) << advised.errors;
  const json document = read("advice.json"), rungs = document["trees"][0]["budgets"];
  ASSERT_GT(rungs.size(), 2U);
  const json &least = rungs.front(), &uncut = rungs[rungs.size() - 2], &none = rungs.back();
  EXPECT_TRUE(least["cuts"]);
  EXPECT_FALSE(uncut["cuts"]);
  EXPECT_TRUE(none["budget_operations"].is_null());
  EXPECT_EQ(document["recommendation"]["certified_error_mean_fraction"], none["certified_error_mean_fraction"]);
  EXPECT_FALSE(document["recommendation"]["cuts"]);
  for (const json& rung : {least, uncut, none}) {
    const std::string budget =
        rung["budget_operations"].is_null() ? "none" : std::to_string(rung["budget_operations"].get<std::uint64_t>());
    const ProgramResult played =
        test::runProgram("frame_budget", "--scene converge --runs 3 --steps 200 --method combined --depth 2 --mesh " +
                                             quoted("ring.obj") + common + "--budget-ops " + budget + " --json " +
                                             quoted("played.json"));
    ASSERT_EQ(played.exitCode, 0) << played.errors;
    const json found = read("played.json");
    EXPECT_EQ(found["unresolved_pairs_fraction"], rung["unresolved_pairs_fraction"]);
    EXPECT_EQ(found["unresolved_pairs_fraction"] > 0, rung["cuts"].get<bool>());
    EXPECT_EQ(found["certified_error_fraction"]["mean"], rung["certified_error_mean_fraction"]);
    EXPECT_EQ(found["certified_error_fraction"]["max"], rung["certified_error_worst_fraction"]);
    EXPECT_LE(rung["certified_error_worst_mildest_start_fraction"], rung["certified_error_worst_fraction"]);
    EXPECT_LE(rung["narrow_phase_p99_quickest_start_us"], rung["narrow_phase_p99_us"]);
  }
}

TEST_F(AdviseProgram, PlaysWhatIsClearlyBehindLessOftenAndSaysSo) {
  const ProgramResult sieved = runJson("sieved.json", "--budget-us 1e6");
  ASSERT_EQ(sieved.exitCode, 0) << sieved.errors;
  const json document = read("sieved.json");
  std::vector<std::uint32_t> playings;
  for (const json& tree : document["trees"]) playings.push_back(tree["playings"]);
  // Half of six are behind. Trees of equal error rank by time, so one of those behind may have to be played again.
  EXPECT_GE(std::ranges::count(playings, 2U), 3) << ::testing::PrintToString(playings);
  EXPECT_EQ(std::ranges::count(playings, 1U) + std::ranges::count(playings, 2U), 6);
  EXPECT_EQ(document["recommendation"]["playings"], 2) << "the choice is one that was played as often as any";
  EXPECT_FALSE(document["thorough"]);
  EXPECT_NE(sieved.output.find("clearly behind less often"), std::string::npos) << sieved.output;
  EXPECT_NE(sieved.output.find("all steps, of all starts and playings"), std::string::npos) << sieved.output;

  const ProgramResult thorough = runJson("thorough.json", "--budget-us 1e6 --thorough");
  ASSERT_EQ(thorough.exitCode, 0) << thorough.errors;
  const json all = read("thorough.json");
  EXPECT_EQ(all["trees"].size(), document["trees"].size()) << "what is named is what is tried";
  for (const json& tree : all["trees"]) EXPECT_EQ(tree["playings"], 2);
  EXPECT_TRUE(all["thorough"]);
  EXPECT_EQ(thorough.output.find("clearly behind"), std::string::npos) << thorough.output;
}

TEST_F(AdviseProgram, SaysWhenNothingFits) {
  const ProgramResult result = runJson("advice.json", "--budget-us 0.001");
  EXPECT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_NE(result.output.find("No tree that was tried"), std::string::npos) << result.output;
  EXPECT_EQ(result.output.find("\n-> combined"), std::string::npos);
  EXPECT_TRUE(read("advice.json")["recommendation"].is_null());
}

TEST_F(AdviseProgram, DrawsTheCurves) {
  if (const Status there = accuracy_cost::checkGnuplot(); !there) GTEST_SKIP() << there.error().message;
  ASSERT_EQ(run("--budget-us 100 --figure " + quoted("curves.svg")).exitCode, 0);
  EXPECT_NE(contentOf(path("curves.svg")).find("combined 8x2"), std::string::npos);
  EXPECT_EQ(contentOf(path("curves.png")).substr(1, 3), "PNG");
  EXPECT_FALSE(fs::exists(path("curves.svg.csv"))) << "nothing of the work is left over";
}

void expectOneSentence(const ProgramResult& result, int code, const std::string& words) {
  EXPECT_EQ(result.exitCode, code) << result.errors;
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
  EXPECT_EQ(result.errors.rfind("cairn advise: ", 0), 0U) << result.errors;
  EXPECT_NE(result.errors.find(words), std::string::npos) << result.errors;
  EXPECT_TRUE(result.output.empty()) << result.output;
}

TEST_F(AdviseProgram, RefusesInOneSentence) {
  expectOneSentence(run(""), 2, "--budget-us");
  for (const char* budget : {"0", "-5", "nan", "inf", "much"})
    expectOneSentence(run("--budget-us " + std::string(budget)), 2, "microseconds");
  expectOneSentence(run("--budget-us 5 --methods magic"), 2, "magic");
  expectOneSentence(run("--budget-us 5 --depths 0"), 2, "--depths");
  expectOneSentence(run("--budget-us 5 --bodies 1"), 2, "--bodies");
  expectOneSentence(run("--budget-us 5 --figure " + quoted("a.png")), 2, ".svg");
  expectOneSentence(run("--budget-us 5 --json " + quoted("no/a.json")), 1, "does not exist");
  expectOneSentence(run("--budget-us 5 --json " + quoted("ring.obj")), 1, "is the same file as");
  expectOneSentence(test::runProgram("cairn", "advise " + quoted("ring.obj") +
                                                  " --budget-us 5 --methods octree --depths 1 --frames 1"),
                    1, "no bodies touch");
  expectOneSentence(test::runProgram("cairn", "advise " + quoted("ring.obj") +
                                                  " --budget-us 5 --methods octree,solid-octree --branching 4"),
                    2, "octrees have 8 children");
  expectOneSentence(run("--budget-us 5 --json " + quoted("a.svg") + " --figure " + quoted("a.svg")), 1,
                    "is the same file as");
  expectOneSentence(test::runProgram("cairn", "advise " + quoted("none.obj") + " --budget-us 5"), 1, "none.obj");
  ASSERT_TRUE(writeFileAtomically(path("open.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  expectOneSentence(test::runProgram("cairn", "advise " + quoted("open.obj") + " --budget-us 5"), 1, "open");
}

TEST_F(AdviseProgram, StandsBesideCairn) {
  const ProgramResult help = test::runProgram("cairn", "advise --help");
  EXPECT_EQ(help.exitCode, 0) << help.errors;
  EXPECT_NE(help.output.find("cairn advise bunny.obj --bodies 50"), std::string::npos) << help.output;
  EXPECT_NE(test::runProgram("cairn", "--help").output.find("cairn advise rock.obj"), std::string::npos);
  fs::copy_file(fs::read_symlink("/proc/self/exe").parent_path() / "cairn", path("cairn"));
  const std::string alone = quoted("cairn") + " advise rock.obj --budget-us 5 > /dev/null 2> " + quoted("errors");
  const int status = std::system(alone.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const std::string errors = contentOf(path("errors"));
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  EXPECT_NE(errors.find("cairn-advise"), std::string::npos) << errors;
}

TEST_F(AdviseProgram, IsCancelledWithoutAResult) {
  const std::string program = (fs::read_symlink("/proc/self/exe").parent_path() / "cairn").string();
  const std::vector<std::string> arguments{"advise", path("ring.obj").string(),    "--budget-us", "100",
                                           "--json", path("advice.json").string(), "--repeats",   "100"};
  EXPECT_EQ(test::exitCodeAfterSignal(program, arguments, SIGINT, std::chrono::milliseconds(700)), 130);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(temporary_.path())) ++files;
  EXPECT_EQ(files, 1U) << "the mesh alone";
}

}  // namespace
}  // namespace cairn::advise::program_test
