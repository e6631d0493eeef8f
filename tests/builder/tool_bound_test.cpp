// SPDX-License-Identifier: GPL-3.0-or-later
//
// `cairn bound` as a user meets it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "builder_meshes.h"
#include "run_program.h"

namespace cairn::builder::tool_bound_test {
namespace {

using Json = nlohmann::json;
using test::ProgramResult;

class BoundTool : public testing::Test {
 protected:
  void SetUp() override { test::writeText(path("rock.obj"), test::objText(test::lumpyBall(3, 3))); }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string quoted(const std::string& name) const { return "'" + path(name) + "'"; }
  ProgramResult bound(const std::string& more) const {
    return test::runProgram("cairn", "bound " + quoted("rock.obj") + " " + more);
  }

  test::TemporaryFolder folder_;
};

TEST_F(BoundTool, SetsTheLevelsOfATreeBesideTheirBounds) {
  ASSERT_EQ(test::runProgram("cairn", "build " + quoted("rock.obj") + " -o " + quoted("rock.cairn") +
                                          " --depth 1 --branching 4 --samples 500 --no-evaluate")
                .exitCode,
            0);
  const ProgramResult result = bound("--points 60 --spheres 1,2 --tree " + quoted("rock.cairn") + " --json -");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const Json report = Json::parse(result.output);
  const Json& bounds = report.at("bounds");
  ASSERT_EQ(bounds.size(), 3U);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    EXPECT_GT(bounds[i].at("lower_bound_fraction"), 0);
    if (i == 0) continue;
    EXPECT_GE(bounds[i].at("spheres"), bounds[i - 1].at("spheres"));
    EXPECT_LE(bounds[i].at("lower_bound_fraction"), bounds[i - 1].at("lower_bound_fraction"));
  }
  const Json& level = bounds[2];
  EXPECT_EQ(level.at("level"), 1);
  EXPECT_GE(level.at("ratio"), 1);
  EXPECT_FALSE(bounds[0].contains("level"));
}

TEST_F(BoundTool, EndsWhenItsTimeIsUpWithWhatIsProved) {
  // Two seconds are enough for a core of its own; a crowded machine gets more.
  double lower = 0;
  for (int limit = 2; lower <= 0.01 && limit <= 128; limit *= 4) {
    const ProgramResult result = bound("--spheres 3,6 --points 20000 --json - --time " + std::to_string(limit));
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const Json report = Json::parse(result.output);
    EXPECT_EQ(report.at("time_limit_s"), limit);
    for (const Json& bound : report.at("bounds")) EXPECT_EQ(bound.at("stopped_by_time"), true);
    lower = report.at("bounds")[1].at("lower_bound_fraction");
  }
  EXPECT_GT(lower, 0.01);
  const ProgramResult words = bound("--spheres 3 --points 20000 --time 1");
  ASSERT_EQ(words.exitCode, 0) << words.errors;
  EXPECT_NE(words.output.find("stopped by time after 1 s"), std::string::npos) << words.output;
}

TEST_F(BoundTool, SaysThatNothingWasProvedAndWhatToDo) {
  const ProgramResult result = bound("--spheres 500 --points 60");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_NE(result.output.find("nothing was proved for 500 spheres: try more --points"), std::string::npos)
      << result.output;
  EXPECT_EQ(result.output.find("stopped by time"), std::string::npos);
}

TEST_F(BoundTool, RefusesInOneSentence) {
  for (const auto& [arguments, exitCode, part] :
       {std::tuple{"", 2, "--spheres, or --tree"}, std::tuple{"--spheres 0", 2, "--spheres"},
        std::tuple{"--spheres 2 --time 0", 2, "seconds above 0"}, std::tuple{"--spheres 2 --time nan", 2, "--time"},
        std::tuple{"--spheres 2 --points 3", 1, "3 points"}, std::tuple{"--tree nowhere.cairn", 1, "nowhere.cairn"}}) {
    const ProgramResult result = bound(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << arguments;
    EXPECT_EQ(result.errors.rfind("cairn: ", 0), 0U) << result.errors;
    EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    EXPECT_EQ(result.output, "");
  }
}

}  // namespace
}  // namespace cairn::builder::tool_bound_test
