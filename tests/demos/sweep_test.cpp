// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "cairn/core/tree_file.h"
#include "run_program.h"
#include "scene_trees.h"

namespace cairn::test::sweep_test {
namespace {

using Json = nlohmann::json;

/// Sweeps of the program over a small rock.
class Sweep : public ::testing::Test {
 protected:
  void SetUp() override {
    const Status saved = saveTree(*smallRockTree(), tree_);
    ASSERT_TRUE(saved) << saved.error().message;
  }
  std::string path(const char* name) const { return (folder_.path() / name).string(); }

  /// The rows of a sweep.
  Json run(const std::string& arguments) {
    const ProgramResult result =
        runProgram("frame_budget", "--tree '" + tree_.string() + "' --json '" + path("a.json") + "' --csv '" +
                                       path("a.csv") + "' " + arguments);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    printed_ = result.output;
    return Json::parse(contentOf(path("a.json")));
  }

  static std::ptrdiff_t linesOf(const std::string& text) { return std::ranges::count(text, '\n'); }

  TemporaryFolder folder_;
  std::filesystem::path tree_ = folder_.path() / "rock.cairn";
  std::string printed_;
};

TEST_F(Sweep, MeasuresEveryCombinationOnceAndNoShapeForWhatItDoesNotDependOn) {
  const Json rows =
      run("--scene heap,rockfall --bodies 3,4 --steps 60 --shape tree,gimpact --budget-ops 500,none "
          "--priority round-robin,worst-error --margin-fraction none,0.01");
  // Of each scene and count: a tree for 2 budgets and 2 priorities, GImpact for 2 margins.
  ASSERT_EQ(rows.size(), 2U * 2U * (4U + 2U));
  EXPECT_EQ(linesOf(contentOf(path("a.csv"))), 1 + std::ssize(rows));
  EXPECT_EQ(linesOf(printed_), 2 + std::ssize(rows));
  int diverged = 0;
  for (const Json& row : rows) {
    if (row.at("shape") == "gimpact") EXPECT_TRUE(row.at("budget_ops").is_null());
    for (const char* key : {"jitter_m_per_s", "divergence_1s_fraction", "divergence_end_fraction", "missed_pairs"})
      EXPECT_TRUE(row.at(key).is_number()) << key;
    const bool isExact = row.at("shape") == "gimpact" && row.at("margin_fraction").is_null();
    if (isExact) EXPECT_EQ(row.at("divergence_end_fraction"), 0);
    diverged += row.at("divergence_end_fraction") > 0;
  }
  EXPECT_GT(diverged, 0);
  EXPECT_EQ(rows[0].at("shape"), "gimpact") << "the exact run is made first";
}

TEST_F(Sweep, GivesTheFiguresOfTheSingleRun) {
  const Json rows = run("--scene heap,converge --runs 1 --bodies 5 --steps 100 --shape tree,hull --budget-ops 300,900");
  for (const Json& row : rows) {
    const bool isTree = row.at("shape") == "tree";
    const std::string budget = isTree ? " --budget-ops " + std::to_string(row.at("budget_ops").get<int>()) : "";
    const Json one =
        run("--scene " + row.at("scene").get<std::string>() + " --bodies 5 --steps 100 --shape " +
            row.at("shape").get<std::string>() + budget + (row.at("scene") == "converge" ? " --runs 1" : ""));
    for (const auto& [key, value] : one.items()) {
      ASSERT_TRUE(row.contains(key)) << key;
      if (key.find("cpu_us") == std::string::npos) EXPECT_EQ(row.at(key), value) << key;
    }
    for (const char* key : {"jitter_m_per_s", "divergence_1s_fraction"}) EXPECT_FALSE(one.contains(key)) << key;
  }
}

TEST_F(Sweep, RockfallHasTheKeysOfAHeap) {
  const Json heap = run("--bodies 3 --steps 5"), rocks = run("--scene rockfall --bodies 3 --steps 5");
  for (const auto& [key, value] : heap.items()) EXPECT_TRUE(rocks.contains(key)) << key;
  EXPECT_EQ(rocks.at("time_step_s"), 1.0 / 120);
  EXPECT_EQ(rocks.at("bodies_lost"), 0);
}

TEST_F(Sweep, LeavesWhatIsDoneWhenItIsCancelled) {
  const std::string program = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "frame_budget").string();
  const std::string csv = path("a.csv");
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    // The second combination would take for ever.
    execl(program.c_str(), program.c_str(), "--tree", tree_.c_str(), "--scene", "heap", "--bodies", "1,200", "--steps",
          "5000", "--csv", csv.c_str(), nullptr);
    _exit(127);
  }
  constexpr int kPatience = 600;
  for (int i = 0; i < kPatience && !std::filesystem::exists(csv); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(linesOf(contentOf(csv)), 2) << "a head and one combination";
}

}  // namespace
}  // namespace cairn::test::sweep_test
