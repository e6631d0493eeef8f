// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <sstream>
#include <string>
#include <thread>

#include "case_documents.h"
#include "rockfall/case/case.h"
#include "rockfall/ensemble/run_folder.h"
#include "run_program.h"

namespace cairn::rockfall::program_test {
namespace {

using nlohmann::json;
using test::contentOf;
using test::ProgramResult;

/// The program on a small case: twelve runs of six rocks, a fraction of a second each.
class RockfallProgram : public ::testing::Test {
 protected:
  RockfallProgram() {
    json document = test::plainCase();
    document["rocks"][0]["count"] = 6;
    document["rocks"][0]["tree_depth"] = 1;
    document["duration_s"] = 2;
    std::ofstream(path("plain.json")) << "// remarks are allowed\n" << document.dump(1);
  }

  std::string path(const std::string& name) const { return (temporary_.path() / name).string(); }
  std::string quoted(const std::string& name) const { return "'" + path(name) + "'"; }
  std::string runArguments(const std::string& folder, const std::string& rest = "--runs 0:12") const {
    return "run " + quoted("plain.json") + " --cache " + quoted("trees") + " -o " + quoted(folder) + " " + rest;
  }
  ProgramResult rockfall(const std::string& arguments) const { return test::runProgram("rockfall", arguments); }

  /// Merges folders into one and gives the hash over all that was written.
  std::string mergedHash(const std::string& folders) const {
    const ProgramResult merged = rockfall("merge " + folders + " -o " + quoted("merged"));
    EXPECT_EQ(merged.exitCode, 0) << merged.errors;
    const auto manifest = json::parse(contentOf(temporary_.path() / "merged" / "manifest.json"));
    const std::string hash = manifest.at("merged_hash");
    EXPECT_NE(merged.output.find(hash), std::string::npos) << merged.output;
    return hash;
  }
  std::string hashOfOneProcess() const {
    const ProgramResult run = rockfall(runArguments("alone"));
    EXPECT_EQ(run.exitCode, 0) << run.errors;
    return mergedHash(quoted("alone"));
  }

  test::TemporaryFolder temporary_;
};

TEST_F(RockfallProgram, MergesTheSameFromOneTwoAndSevenWorkers) {
  const std::string alone = hashOfOneProcess();
  for (const char* jobs : {"2", "7"}) {
    const ProgramResult run =
        rockfall(runArguments(std::string("jobs") + jobs, std::string("--runs 0:12 --jobs ") + jobs));
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    EXPECT_EQ(mergedHash(quoted(std::string("jobs") + jobs)), alone) << jobs;
  }
}

TEST_F(RockfallProgram, MergesTheSameFromPartsInAnyOrder) {
  const std::string alone = hashOfOneProcess();
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    const std::string name = std::string("part") + part[0];
    ASSERT_EQ(rockfall(runArguments(name, std::string("--runs 0:12 --part ") + part)).exitCode, 0);
  }
  EXPECT_EQ(mergedHash(quoted("part3") + " " + quoted("part1") + " " + quoted("part2")), alone);
  EXPECT_NE(mergedHash(quoted("part3") + " " + quoted("part1")), alone) << "four runs are missing";
}

TEST_F(RockfallProgram, TellsWhichRunsAreMissing) {
  ASSERT_EQ(rockfall(runArguments("part", "--runs 0:6 --part 1/2")).exitCode, 0);
  ASSERT_EQ(rockfall(runArguments("later", "--runs 10:12")).exitCode, 0);
  const ProgramResult merged = rockfall("merge " + quoted("later") + " " + quoted("part") + " -o " + quoted("merged"));
  EXPECT_EQ(merged.exitCode, 0) << merged.errors;
  EXPECT_NE(merged.output.find("\n7 of 12 runs are missing, and the results do without them: 3 to 9.\n"),
            std::string::npos)
      << merged.output;
  const auto summary = json::parse(contentOf(temporary_.path() / "merged" / "summary.json"));
  EXPECT_EQ(summary.at("runs"), 5);
  EXPECT_EQ(summary.at("missing_runs"), 7);
  EXPECT_EQ(summary.at("missing_run_ranges"), json::parse("[[3, 10]]"));
  hashOfOneProcess();
  const auto whole = json::parse(contentOf(temporary_.path() / "merged" / "summary.json"));
  EXPECT_EQ(whole.at("missing_runs"), 0);
}

/// Starts the program and kills it outright once the folder holds some runs.
void killInTheMiddle(const std::string& program, const std::vector<std::string>& arguments,
                     const std::filesystem::path& folder) {
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char*> words{const_cast<char*>(program.c_str())};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    execv(program.c_str(), words.data());
    _exit(127);
  }
  while (runsIn(folder).size() < 3 && waitpid(child, nullptr, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST_F(RockfallProgram, KilledOutrightGoesOnWhereItWas) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "rockfall";
  const std::vector<std::string> arguments{"run", path("plain.json"), "--cache", path("trees"),
                                           "-o",  path("killed"),     "--runs",  "0:60"};
  killInTheMiddle(program, arguments, path("killed"));
  const std::size_t kept = runsIn(path("killed")).size();
  ASSERT_GE(kept, 3U);
  ASSERT_LT(kept, 60U) << "it was killed before it was done";
  const ProgramResult early = rockfall("merge " + quoted("killed") + " -o " + quoted("early"));
  EXPECT_EQ(early.exitCode, 0) << early.errors;
  EXPECT_NE(early.output.find(std::to_string(60 - kept) + " of 60 runs are missing"), std::string::npos)
      << early.output;
  const ProgramResult resumed = rockfall(runArguments("killed", "--runs 0:60"));
  ASSERT_EQ(resumed.exitCode, 0) << resumed.errors;
  EXPECT_NE(resumed.output.find(std::to_string(60 - kept) + " computed, " + std::to_string(kept) + " were there"),
            std::string::npos)
      << resumed.output;
  ASSERT_EQ(rockfall(runArguments("whole", "--runs 0:60 --jobs 2")).exitCode, 0);
  EXPECT_EQ(mergedHash(quoted("killed")), mergedHash(quoted("whole")));
}

TEST_F(RockfallProgram, MergesTheSameThroughGnuParallel) {
  if (std::system("parallel --version 2> /dev/null | grep -q GNU") != 0)
    GTEST_SKIP() << "needs GNU parallel, Debian's package parallel";
  const std::string alone = hashOfOneProcess();
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "rockfall";
  const std::string command = "parallel --will-cite -j 2 --joblog " + quoted("jobs.log") + " --resume '" +
                              program.string() + "' " + runArguments("part-{}", "--runs 0:12 --part {}/3") +
                              " ::: 1 2 3 > /dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  const std::string log = contentOf(path("jobs.log"));
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 4) << "a heading and three jobs:\n" << log;
  EXPECT_EQ(mergedHash(quoted("part-2") + " " + quoted("part-3") + " " + quoted("part-1")), alone);
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(contentOf(path("jobs.log")), log) << "nothing was left to do";
}

TEST_F(RockfallProgram, WritesWhatTheCaseAsksFor) {
  hashOfOneProcess();
  const std::filesystem::path merged = temporary_.path() / "merged";
  const auto linesOf = [&](const char* name) {
    const std::string text = contentOf(merged / name);
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(linesOf("runs.csv"), 1 + 12);
  EXPECT_EQ(linesOf("rocks.csv"), 1 + 12 * 6);
  EXPECT_EQ(linesOf("reach.asc"), 6 + 20);
  const auto summary = json::parse(contentOf(merged / "summary.json"));
  EXPECT_EQ(summary.at("rocks"), 72);
  EXPECT_EQ(summary.at("endings").at("lost"), 0);
  // Of the six rocks of each run, every cell counts each once at most; where they begin is the most visited part.
  std::istringstream raster(contentOf(merged / "reach.asc"));
  for (std::string line; std::getline(raster, line) && line.rfind("NODATA", 0) != 0;) continue;
  double greatest = 0;
  for (double value = 0; raster >> value;) greatest = std::max(greatest, value);
  EXPECT_GT(greatest, 1);
  EXPECT_LE(greatest, 72);
  const std::string vtk = contentOf(merged / "trajectories.vtk");
  EXPECT_NE(vtk.find("\nLINES 72 "), std::string::npos);
  EXPECT_NE(vtk.find("\nPOINTS 1512 double\n"), std::string::npos) << "21 samples in two seconds, both ends";
  for (const char* figure : {"map.svg", "profiles.svg"}) EXPECT_EQ(contentOf(merged / figure).rfind("<svg ", 0), 0U);
}

/// `column` of a table with a heading, summed over all lines.
double sumOf(const std::string& table, const std::string& column) {
  std::istringstream lines(table);
  std::string line, cell;
  std::getline(lines, line);
  std::istringstream heading(line);
  std::ptrdiff_t place = 0;
  while (std::getline(heading, cell, ',') && cell != column) ++place;
  double sum = 0;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    for (std::ptrdiff_t i = 0; i <= place; ++i) std::getline(cells, cell, ',');
    sum += std::stod(cell);
  }
  return sum;
}

TEST_F(RockfallProgram, TellsWhatEachEffectDid) {
  hashOfOneProcess();
  const std::filesystem::path merged = temporary_.path() / "merged";
  const auto summary = json::parse(contentOf(merged / "summary.json"));
  const std::string table = contentOf(merged / "effects.csv");
  const auto& effects = summary.at("effects");
  ASSERT_EQ(effects.size(), 1U);
  EXPECT_EQ(effects[0].at("effect"), "friction");
  EXPECT_EQ(effects[0].at("path"), "/effects/0");
  EXPECT_GT(effects[0].at("acts"), 0);
  EXPECT_GT(effects[0].at("impulse_n_s"), 0);
  // Friction is all that acts; what else is lost, blows take.
  EXPECT_GT(effects[0].at("energy_taken_j"), 0);
  EXPECT_LT(effects[0].at("energy_taken_j"), summary.at("released_energy_j"));
  constexpr double kDigits = 1e-5;  // of the table
  for (const char* column : {"acts", "energy_taken_j", "impulse_n_s"}) {
    const double told = effects[0].at(column);
    EXPECT_NEAR(sumOf(table, column), told, kDigits * told) << column;
  }
}

TEST_F(RockfallProgram, DrawsPngOrSaysWhatIsMissing) {
  ASSERT_EQ(rockfall(runArguments("one", "--runs 0:1")).exitCode, 0);
  const ProgramResult merged = rockfall("merge --png " + quoted("one") + " -o " + quoted("merged"));
  if (merged.exitCode == 0)
    EXPECT_EQ(contentOf(temporary_.path() / "merged" / "map.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  else
    EXPECT_NE(merged.errors.find("install the package librsvg2-bin"), std::string::npos) << merged.errors;
  ASSERT_EQ(setenv("PATH", path("nowhere").c_str(), 1), 0);
}

TEST_F(RockfallProgram, RefusesBadCasesWithExitCodeOneAndLeavesNothing) {
  std::ofstream(path("bad.json")) << R"({"case": "x", "sed": 1})";
  const ProgramResult bad = rockfall("run " + quoted("bad.json") + " -o " + quoted("out"));
  EXPECT_EQ(bad.exitCode, 1);
  EXPECT_EQ(bad.errors, "rockfall: " + path("bad.json") + ": /sed: no such key here (did you mean \"seed\"?).\n");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  const ProgramResult missing = rockfall("explain " + quoted("none.json"));
  EXPECT_EQ(missing.exitCode, 1);
  EXPECT_NE(missing.errors.find("none.json"), std::string::npos);
  const ProgramResult proc = rockfall("run " + quoted("plain.json") + " --cache " + quoted("trees") + " -o /proc/nope");
  EXPECT_EQ(proc.exitCode, 1);
  EXPECT_NE(proc.errors.find("cannot make the folder /proc/nope"), std::string::npos) << proc.errors;
}

TEST_F(RockfallProgram, PrintsTheSchema) {
  EXPECT_EQ(rockfall("schema").output, caseSchema());
}

TEST_F(RockfallProgram, ExplainWarnsOfWhatCanNeverAct) {
  json document = test::plainCase();
  document["rocks"][0]["tree_depth"] = 1;
  document["effects"].push_back({{"effect", "water"}, {"level_m", -5}});
  std::ofstream(path("dry.json")) << document.dump();
  const ProgramResult told =
      rockfall("explain " + quoted("dry.json") + " --cache " + quoted("trees") + " --json " + quoted("dry-told.json"));
  ASSERT_EQ(told.exitCode, 0) << told.errors;
  EXPECT_NE(told.output.find("warning: /effects/1: \"water\" can never act"), std::string::npos) << told.output;
  const auto twin = json::parse(contentOf(path("dry-told.json")));
  EXPECT_EQ(twin.at("effects").at(0).at("can_act"), true);
  EXPECT_EQ(twin.at("effects").at(1).at("can_act"), false);
}

}  // namespace
}  // namespace cairn::rockfall::program_test
