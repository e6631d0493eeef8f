// SPDX-License-Identifier: GPL-3.0-or-later
//
// `cairn fracture` as a user meets it.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>

#include "builder_meshes.h"
#include "cairn/core/tree_file.h"
#include "interrupted_program.h"
#include "run_program.h"

namespace cairn::builder::tool_fracture_test {
namespace {

using Json = nlohmann::json;

class ToolFracture : public testing::Test {
 protected:
  void SetUp() override { test::writeText(path("rock.obj"), test::objText(test::lumpyBall(3, 3))); }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  test::ProgramResult fracture(const std::string& mesh) const {
    return test::runProgram("cairn",
                            "fracture '" + path(mesh) + "' -o '" + path("pieces") + "' --method octree --depth 1");
  }

  test::TemporaryFolder folder_;
};

TEST_F(ToolFracture, WritesPiecesTheirTreesAndAList) {
  const test::ProgramResult result = fracture("rock.obj");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const Json list = Json::parse(test::contentOf(path("pieces/rock.fracture.json")));
  ASSERT_EQ(list.at("pieces").size(), 8U);
  EXPECT_LE(list.at("volume_error_fraction").get<double>(), 1e-9);
  for (const Json& piece : list.at("pieces")) {
    EXPECT_TRUE(std::filesystem::exists(path("pieces/" + piece.at("mesh").get<std::string>())));
    const auto tree = loadTree(path("pieces/" + piece.at("tree").get<std::string>()));
    ASSERT_TRUE(tree) << tree.error().message;
    EXPECT_EQ(tree.value().mass().volume, piece.at("volume").get<double>());
  }
  for (const Json& bond : list.at("bonds")) EXPECT_GT(bond.at("area").get<double>(), 0);
}

TEST_F(ToolFracture, RefusesAFileAsFolderBeforeAnyWork) {
  test::writeText(path("pieces"), "a file");
  const test::ProgramResult result = fracture("missing.obj");
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.errors.find("is no folder"), std::string::npos) << result.errors;
  EXPECT_EQ(test::contentOf(path("pieces")), "a file");
}

TEST_F(ToolFracture, Interrupted_EndsWith130AndLeavesNothing) {
  test::writeText(path("large.obj"), test::objText(test::lumpyBall(40, 3)));
  const std::vector<std::string> arguments = {"fracture", path("large.obj"), "-o", path("pieces"), "--depth", "5"};
  for (const int delay : {300, 2000})
    EXPECT_EQ(test::exitCodeAfterSignal(CAIRN_TOOL, arguments, SIGINT, std::chrono::milliseconds(delay)), 130);
  EXPECT_FALSE(std::filesystem::exists(path("pieces")));
}

TEST_F(ToolFracture, RefusesAnOpenMeshAndWritesNothing) {
  TriangleMesh open = test::lumpyBall(2, 3);
  open.triangles.pop_back();
  test::writeText(path("open.obj"), test::objText(open));
  const test::ProgramResult result = fracture("open.obj");
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.errors.find("open.obj"), std::string::npos) << result.errors;
  EXPECT_FALSE(std::filesystem::exists(path("pieces")));
}

}  // namespace
}  // namespace cairn::builder::tool_fracture_test
