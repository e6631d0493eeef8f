// SPDX-License-Identifier: GPL-3.0-or-later
//
// `cairn cover`, and `cairn export` of what it writes, as a user meets them.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "builder_meshes.h"
#include "interrupted_program.h"
#include "run_program.h"

namespace cairn::builder::tool_cover_test {
namespace {

using Json = nlohmann::json;
using test::ProgramResult;

class CoverTool : public testing::Test {
 protected:
  void SetUp() override { test::writeText(path("rock.obj"), test::objText(test::lumpyBall(2, 3))); }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string quoted(const std::string& name) const { return "'" + path(name) + "'"; }
  static ProgramResult run(const std::string& arguments) { return test::runProgram("cairn", arguments); }
  Json jsonOf(const std::string& name) const { return Json::parse(test::contentOf(path(name))); }

  test::TemporaryFolder folder_;
};

TEST_F(CoverTool, WritesALineASphereAndAReportThatAgrees) {
  const ProgramResult result =
      run("cover " + quoted("rock.obj") + " --spheres 5 -o " + quoted("c.txt") + " --json " + quoted("c.json"));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  std::istringstream lines(test::contentOf(path("c.txt")));
  std::size_t count = 0;
  double worst = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    std::istringstream words(line);
    double n[6] = {};
    for (double& value : n) ASSERT_TRUE(words >> value) << line;
    worst = std::max(worst, n[4]);
  }
  const Json report = jsonOf("c.json");
  EXPECT_EQ(count, 5U);
  EXPECT_EQ(report.at("spheres"), 5);
  EXPECT_EQ(report.at("objective"), "outer");
  EXPECT_EQ(report.at("certified").at("sticks_out").at("at_most").get<double>(), worst);
  EXPECT_EQ(report.at("certified").at("leaves_out_surface").at("at_most"), 0);
  EXPECT_EQ(report.at("certified").at("surface_covered"), true);
  // The sampled figure never exceeds the proved one, and the volumes agree: ratio = 1 + excess - uncovered.
  const Json& sampled = report.at("sampled");
  EXPECT_LE(sampled.at("sticks_out_fraction"), report.at("certified_error_fraction"));
  const double ratio =
      1 + sampled.at("excess_volume_fraction").get<double>() - sampled.at("uncovered_volume_fraction").get<double>();
  EXPECT_NEAR(report.at("volume_ratio").get<double>(), ratio,
              5 * sampled.at("excess_volume_standard_error_fraction").get<double>() + 1e-4);
}

TEST_F(CoverTool, GoesToGrainsWithTheMeshsMass) {
  ASSERT_EQ(run("cover " + quoted("rock.obj") + " --spheres 4 --no-evaluate -o " + quoted("c.txt")).exitCode, 0);
  const ProgramResult result =
      run("export " + quoted("c.txt") + " --mesh " + quoted("rock.obj") + " --to liggghts --density 2650 -o " +
          quoted("rock.ms") + " --json " + quoted("g.json"));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const Json report = jsonOf("g.json");
  EXPECT_EQ(report.at("stands_for"), "mesh");
  EXPECT_EQ(report.at("frame"), "center_of_mass");
  const double mass = report.at("mass").at("mesh").at("mass");
  EXPECT_NEAR(mass, 2650 * report.at("mass").at("mesh").at("volume").get<double>(), 1e-9 * mass);
  EXPECT_GT(report.at("mass").at("spheres").at("volume"), report.at("mass").at("mesh").at("volume"));
  // LIGGGHTS wants the mass and the inertia tensor, or neither.
  std::istringstream words(report.at("liggghts").get<std::string>());
  std::vector<std::string> list;
  for (std::string word; words >> word;) list.push_back(word);
  const auto at = std::find(list.begin(), list.end(), "mass");
  ASSERT_EQ(list.end() - at, 9);
  EXPECT_DOUBLE_EQ(std::stod(at[1]), mass);
  EXPECT_EQ(at[2], "inertia_tensor");
  const Json& inertia = report.at("mass").at("mesh").at("inertia");
  const std::pair<int, int> places[] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  for (int k = 0; k < 6; ++k)
    EXPECT_DOUBLE_EQ(std::stod(at[3 + k]), inertia[places[k].first][places[k].second].get<double>());
  const ProgramResult neither = run("export " + quoted("c.txt") + " --to liggghts -o " + quoted("x.ms") + " --json -");
  ASSERT_EQ(neither.exitCode, 0) << neither.errors;
  EXPECT_EQ(Json::parse(neither.output).at("stands_for"), "spheres");
  EXPECT_EQ(neither.output.find("inertia_tensor"), std::string::npos);
}

TEST_F(CoverTool, ExportsLevelsOfTreesAndCoversAlike) {
  ASSERT_EQ(
      run("build " + quoted("rock.obj") + " -o " + quoted("rock.cairn") + " --depth 2 --samples 500 --no-evaluate")
          .exitCode,
      0);
  for (const std::string form : {"liggghts", "yade", "chrono", "clump", "glb", "obj"}) {
    const std::string file = "level." + (form == "glb" || form == "obj" ? form : "txt");
    const ProgramResult result =
        run("export " + quoted("rock.cairn") + " --to " + form + " --level 1 -o " + quoted(file) + " --json -");
    ASSERT_EQ(result.exitCode, 0) << form << result.errors;
    EXPECT_EQ(Json::parse(result.output).at("stands_for"), "mesh");
    EXPECT_GT(test::contentOf(path(file)).size(), 0U);
  }
  test::writeText(path("c.txt"), "0 0 0 1\n1 0 0 0.5\n");
  EXPECT_EQ(run("export " + quoted("c.txt") + " --to glb -o " + quoted("c.glb")).exitCode, 0);
}

TEST_F(CoverTool, RefusesInOneSentence) {
  test::writeText(path("c.txt"), "0 0 0 1\n");
  const std::string rock = "cover " + quoted("rock.obj"), out = " -o " + quoted("o.txt");
  for (const auto& [arguments, exitCode, part] :
       {std::tuple{rock + out, 2, "--spheres or --max-error"}, std::tuple{rock + " --spheres 0" + out, 2, "--spheres"},
        std::tuple{rock + " --spheres 3 --max-error 1" + out, 2, "--max-error"},
        std::tuple{rock + " --max-error nan" + out, 2, "nan"}, std::tuple{rock + " --max-error -1" + out, 2, "-1"},
        std::tuple{rock + " --spheres 3 --objective best" + out, 2, "best"},
        std::tuple{rock + " --spheres 3 --symmetric" + out, 1, "mirrors"},
        std::tuple{rock + " --spheres 3 -o " + quoted("no/o.txt"), 1, "no/o.txt"},
        std::tuple{rock + " --spheres 3 -o " + quoted("rock.obj"), 1, "rock.obj"},
        std::tuple{"export " + quoted("c.txt") + " --to spheres" + out, 1, "no levels"},
        std::tuple{"export " + quoted("c.txt") + " --to yade --level 1" + out, 1, "no levels"},
        std::tuple{"export " + quoted("c.txt") + " --to glb --density 3" + out, 2, "--density"},
        std::tuple{"export " + quoted("c.txt") + " --to yade --density 0" + out, 2, "density"},
        std::tuple{"export " + quoted("rock.obj") + " --to yade" + out, 1, "rock.obj"}}) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << arguments;
    EXPECT_EQ(result.errors.rfind("cairn: ", 0), 0U) << result.errors;
    EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    EXPECT_EQ(result.output, "");
    EXPECT_FALSE(std::filesystem::exists(path("o.txt"))) << arguments;
  }
}

TEST_F(CoverTool, EndsSoonAfterAnInterrupt) {
  const auto start = std::chrono::steady_clock::now();
  const int code = test::exitCodeAfterSignal(std::filesystem::read_symlink("/proc/self/exe").parent_path() / "cairn",
                                             {"cover", path("rock.obj"), "--spheres", "500", "-o", path("c.txt")},
                                             SIGINT, std::chrono::milliseconds(700));
  EXPECT_EQ(code, 130);
  EXPECT_FALSE(std::filesystem::exists(path("c.txt")));
  // A second of work, with room for a machine that is busy.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15));
}

}  // namespace
}  // namespace cairn::builder::tool_cover_test
