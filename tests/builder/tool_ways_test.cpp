// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the cairn command behaves towards who waits for it: what it says of its work, and how it is stopped.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <regex>

#include "builder_meshes.h"
#include "interrupted_program.h"
#include "run_program.h"

namespace cairn::builder::tool_ways_test {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

class ToolWays : public testing::Test {
 protected:
  void SetUp() override { test::writeText(path("rock.obj"), test::objText(test::lumpyBall(5, 3))); }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string quoted(const std::string& name) const { return "'" + path(name) + "'"; }
  Json buildRock(const std::string& options) const {
    const auto result = test::runProgram(
        "cairn", "build " + quoted("rock.obj") + " -o " + quoted("rock.cairn") + " --no-evaluate --json - " + options);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    return Json::parse(result.output);
  }

  test::TemporaryFolder folder_;
};

// In stages that ask nobody too. A second, and another for a machine that is busy.
TEST_F(ToolWays, AnInterruptIsHeardWithinASecond) {
  test::writeText(path("large.obj"), test::objText(test::lumpyBall(150, 3)));
  const std::vector<std::vector<std::string>> commands = {
      {"build", path("large.obj"), "-o", path("out.cairn")},
      {"build", path("large.obj"), "-o", path("out.cairn"), "--repair"},
      {"simplify", path("large.obj"), "-o", path("out.obj")},
      {"fracture", path("large.obj"), "-o", path("out")}};
  for (const auto& command : commands) {
    for (const int delay : {300, 1500}) {
      const auto start = Clock::now();
      EXPECT_EQ(test::exitCodeAfterSignal(CAIRN_TOOL, command, SIGINT, std::chrono::milliseconds(delay)), 130);
      EXPECT_LT(Clock::now() - start, std::chrono::milliseconds(delay + 2000)) << command[0] << " " << delay;
    }
  }
  for (const char* output : {"out.cairn", "out.obj", "out"}) EXPECT_FALSE(std::filesystem::exists(path(output)));
}

TEST_F(ToolWays, ProgressOfAPipedRunIsTheLinesOfALog) {
  test::writeText(path("large.obj"), test::objText(test::lumpyBall(40, 3)));
  const std::string command = "timeout --preserve-status -s INT 4 '" CAIRN_TOOL "' build " + quoted("large.obj") +
                              " -o " + quoted("out.cairn") + " --depth 5 --samples 200000 2> " + quoted("log");
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const std::string log = test::contentOf(path("log"));
  EXPECT_TRUE(std::regex_search(log, std::regex("^cairn: +[0-9]+ % [a-z]"))) << log;
  EXPECT_EQ(log.find('\r'), std::string::npos) << log;
}

// Its advice is tried, and gives about the promised error.
TEST_F(ToolWays, ABuildJudgesItsTree) {
  const Json coarse = buildRock("--depth 1");
  const std::string advice = coarse.at("advice");
  std::smatch said;
  const std::regex form(
      "leaf error ([0-9.]+) % of the size: coarse, try (--depth [0-9]+[^,]*), for about ([0-9.]+) %.*");
  ASSERT_TRUE(std::regex_match(advice, said, form)) << advice;
  const double error = coarse.at("leaf_error_fraction");
  EXPECT_NEAR(std::stod(said[1]), 100 * error, 0.051);
  const Json better = buildRock(said[2]);
  EXPECT_LT(100 * better.at("leaf_error_fraction").get<double>(), 2 * std::stod(said[3])) << advice;
  EXPECT_LT(better.at("leaf_error_fraction").get<double>(), 0.5 * error);
  const Json fine = buildRock("--depth 4 --samples 20000");
  EXPECT_LE(fine.at("leaf_error_fraction").get<double>(), 0.025);
  EXPECT_NE(fine.at("advice").get<std::string>().find("fine"), std::string::npos) << fine.at("advice");
}

TEST_F(ToolWays, CertifyWithAWrongMeshSaysTheFirstGapAlone) {
  (void)buildRock("--depth 2");
  test::writeText(path("other.obj"), test::objText(test::lumpyBall(6, 3)));
  const auto result = test::runProgram(
      "cairn", "certify " + quoted("other.obj") + " " + quoted("rock.cairn") + " --json " + quoted("proof.json"));
  EXPECT_EQ(result.exitCode, 1);
  const auto lines = std::ranges::count(result.output, '\n') + std::ranges::count(result.errors, '\n');
  EXPECT_LE(lines, 8) << result.output << result.errors;
  EXPECT_NE(result.errors.find("the first: "), std::string::npos) << result.errors;
  EXPECT_GT(Json::parse(test::contentOf(path("proof.json"))).at("failures").size(), 10U) << "all of them are there";
}

}  // namespace
}  // namespace cairn::builder::tool_ways_test
