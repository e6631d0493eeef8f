// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cairn command as a user meets it: exit codes, messages, reports, and nothing half-written.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>

#include "builder_meshes.h"
#include "interrupted_program.h"
#include "run_program.h"

namespace cairn::builder::tool_test {
namespace {

using Json = nlohmann::json;
using test::ProgramResult;

/// A folder with a mesh, and the tool run inside sight of it.
class Tool : public testing::Test {
 protected:
  void SetUp() override { test::writeText(path("rock.obj"), test::objText(test::lumpyBall(5, 3))); }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string quoted(const std::string& name) const { return "'" + path(name) + "'"; }
  static ProgramResult run(const std::string& arguments) { return test::runProgram("cairn", arguments); }
  ProgramResult build(const std::string& more = "") const {
    return run("build " + quoted("rock.obj") + " -o " + quoted("rock.cairn") +
               " --method octree --depth 2 --samples 500 " + more);
  }
  Json json(const std::string& name) const { return Json::parse(test::contentOf(path(name))); }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  std::size_t fileCount() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }

  test::TemporaryFolder folder_;
};

void expectOneSentence(const ProgramResult& result, int exitCode, const std::string& part) {
  EXPECT_EQ(result.exitCode, exitCode);
  EXPECT_EQ(result.errors.rfind("cairn: ", 0), 0U) << result.errors;
  EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1) << result.errors;
  EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
}

TEST_F(Tool, BuildWritesATreeAndTheReportScriptsRelyOn) {
  const ProgramResult result = build("--json " + quoted("report.json") + " --threads 2 --seed 7");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  EXPECT_TRUE(exists("rock.cairn"));
  const Json report = json("report.json");
  EXPECT_EQ(report.at("mesh"), "rock.obj");
  EXPECT_EQ(report.at("method"), "octree");
  EXPECT_EQ(report.at("branching"), 8);
  EXPECT_EQ(report.at("depth"), 2);
  EXPECT_EQ(report.at("seed"), 7);
  EXPECT_EQ(report.at("threads"), 2);
  EXPECT_GT(report.at("build_cpu_s"), 0);
  EXPECT_GT(report.at("build_wall_s"), 0);
  EXPECT_GT(report.at("peak_rss_mb"), 1);
  EXPECT_EQ(report.at("tree_sha256").get<std::string>().size(), 64U);
  ASSERT_EQ(report.at("levels").size(), 2U);
  for (const Json& level : report.at("levels")) {
    for (const char* key :
         {"level", "spheres", "certified_max_fraction", "certified_rms_fraction", "sampled_max_fraction",
          "sampled_rms_fraction", "sampled_variance_fraction_squared", "uncovered_area_fraction",
          "uncovered_volume_fraction", "uncovered_volume_standard_error_fraction", "uncovered_depth_max_fraction",
          "uncovered_depth_rms_fraction", "wasted_volume_fraction", "wasted_volume_standard_error_fraction"})
      EXPECT_TRUE(level.at(key).is_number()) << key;
    EXPECT_EQ(level.at("coverage_proven"), true);
    EXPECT_EQ(level.at("reachable_proven"), true);
  }
  EXPECT_EQ(report["levels"][0]["level"], 1);
}

TEST_F(Tool, BuildGivesTheSameBytesForAnyNumberOfThreads) {
  ASSERT_EQ(build("--threads 1 --no-evaluate").exitCode, 0);
  const std::string one = test::contentOf(path("rock.cairn"));
  ASSERT_EQ(build("--threads 2 --no-evaluate").exitCode, 0);
  EXPECT_EQ(one, test::contentOf(path("rock.cairn")));
}

TEST_F(Tool, BuildWithoutEvaluationLeavesOutWhatWasNotMeasured) {
  ASSERT_EQ(build("--no-evaluate --json " + quoted("report.json")).exitCode, 0);
  const Json level = json("report.json").at("levels").at(0);
  EXPECT_TRUE(level.contains("certified_max_fraction"));
  EXPECT_FALSE(level.contains("sampled_max_fraction"));
}

TEST_F(Tool, CertifyAndEvaluateAgreeWithTheBuild) {
  ASSERT_EQ(build("--json " + quoted("build.json")).exitCode, 0);
  const std::string files = quoted("rock.obj") + " " + quoted("rock.cairn");
  const ProgramResult certified = run("certify " + files + " --json " + quoted("proof.json"));
  ASSERT_EQ(certified.exitCode, 0) << certified.errors;
  EXPECT_EQ(json("proof.json").at("proven"), true);
  EXPECT_EQ(json("proof.json").at("tree_sha256"), json("build.json").at("tree_sha256"));
  const ProgramResult evaluated = run("evaluate " + files + " --json -");
  ASSERT_EQ(evaluated.exitCode, 0) << evaluated.errors;
  EXPECT_EQ(Json::parse(evaluated.output).at("levels"), json("build.json").at("levels"));
}

TEST_F(Tool, CertifyRefusesATreeOfAnotherMesh) {
  ASSERT_EQ(build("--no-evaluate").exitCode, 0);
  test::writeText(path("other.obj"),
                  test::objText(test::moved(test::lumpyBall(5, 3), [](const Vec3d& v) { return v * 1.2; })));
  const ProgramResult result =
      run("certify " + quoted("other.obj") + " " + quoted("rock.cairn") + " --json " + quoted("p.json"));
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.errors.find("was built from a file of other content"), std::string::npos);
  EXPECT_NE(result.errors.find("is not covered"), std::string::npos) << result.errors;
  EXPECT_EQ(json("p.json").at("proven"), false);
}

TEST_F(Tool, InspectDescribesTheTree) {
  ASSERT_EQ(build("--no-evaluate").exitCode, 0);
  const ProgramResult result = run("inspect " + quoted("rock.cairn") + " --json -");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const Json report = Json::parse(result.output);
  EXPECT_EQ(report.at("levels").size(), 3U);
  EXPECT_EQ(report.at("levels")[0].at("spheres"), 1);
  EXPECT_EQ(report.at("triangles"), 200);
  EXPECT_EQ(report.at("spheres_per_node"), 1);
  EXPECT_EQ(run("inspect " + quoted("rock.cairn")).exitCode, 0);
}

TEST_F(Tool, TwoSpheresANodeAreBuiltProvedAndDescribed) {
  ASSERT_EQ(build("--no-evaluate --two-spheres").exitCode, 0);
  const ProgramResult proof = run("certify " + quoted("rock.obj") + " " + quoted("rock.cairn"));
  EXPECT_EQ(proof.exitCode, 0) << proof.errors;
  const Json report = Json::parse(run("inspect " + quoted("rock.cairn") + " --json -").output);
  EXPECT_EQ(report.at("spheres_per_node"), 2);
  EXPECT_EQ(report.at("method"), "octree+two-spheres");
  const ProgramResult shown = run("inspect " + quoted("rock.cairn"));
  EXPECT_NE(shown.output.find("a sphere that bounds and one that answers"), std::string::npos) << shown.output;
}

TEST_F(Tool, ExportWritesEveryForm) {
  ASSERT_EQ(build("--no-evaluate").exitCode, 0);
  for (const char* form : {"spheres", "sph", "obj", "glb"}) {
    const std::string file = std::string("rock.") + form;
    const ProgramResult result = run("export " + quoted("rock.cairn") + " --to " + form + " -o " + quoted(file));
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_GT(test::contentOf(path(file)).size(), 100U) << form;
  }
  expectOneSentence(run("export " + quoted("rock.cairn") + " --to obj --level 7 -o " + quoted("x.obj")), 1,
                    "levels 0 to 2, not 7");
  EXPECT_FALSE(exists("x.obj"));
}

TEST_F(Tool, AFullDiskIsNoticed) {
  ASSERT_EQ(build("--no-evaluate").exitCode, 0);
  for (const char* form : {"spheres", "sph", "obj", "glb"})
    expectOneSentence(run("export " + quoted("rock.cairn") + " --to " + form + " -o /dev/full"), 1, "/dev/full");
}

TEST_F(Tool, TheLongestNamesCanBeWritten) {
  const std::string longest = std::string(249, 'x') + ".cairn";
  EXPECT_EQ(
      run("build " + quoted("rock.obj") + " --method octree --depth 1 --no-evaluate -o " + quoted(longest)).exitCode,
      0);
  EXPECT_TRUE(exists(longest));
}

TEST_F(Tool, WrongUsageEndsWithTwo) {
  const std::string in = quoted("rock.obj"), out = " -o " + quoted("rock.cairn");
  expectOneSentence(run(""), 2, "subcommand");
  expectOneSentence(run("fly"), 2, "there is no command 'fly'");
  expectOneSentence(run("build " + in), 2, "--output");
  expectOneSentence(run("build " + in + out + " --branching 9"), 2, "--branching");
  expectOneSentence(run("build " + in + out + " --branching 1"), 2, "--branching");
  expectOneSentence(run("build " + in + out + " --depth 0"), 2, "--depth");
  expectOneSentence(run("build " + in + out + " --samples 5"), 2, "--samples");
  expectOneSentence(run("build " + in + out + " --method magic"), 2, "--method");
  for (const char* seed : {"minus", "-1", "99999999999999999999", "1.5", "''"})
    expectOneSentence(run("build " + in + out + " --seed " + seed), 2, "--seed");
  expectOneSentence(run("evaluate " + in + " rock.cairn --seed=-1"), 2, "--seed");
  expectOneSentence(run("build " + in + out + " --method octree --branching 4"), 2, "--branching");
  expectOneSentence(run("build " + in + out + " --balance 5%"), 2, "--balance");
  expectOneSentence(run("build " + in + out + " --optimise well"), 2, "--optimise");
  expectOneSentence(run("build " + in + out + " --method octree --balance 0.05"), 2, "--balance");
  expectOneSentence(run("build " + in + out + " --division planes"), 2, "--division");
  expectOneSentence(run("build " + in + out + " --method octree --division planes"), 2, "--division");
  expectOneSentence(run("build " + in + out + " --method grid --optimise cairn --division planes"), 2, "--division");
  expectOneSentence(run("build " + in + out + " --method adaptive --optimise thesis"), 2, "--optimise");
  expectOneSentence(run("export a.cairn --to sph --level 1 -o b"), 2, "--level");
  expectOneSentence(run("export a.cairn --to glb -o b.obj"), 2, "ends in .obj");
  expectOneSentence(run("bound " + in), 2, "--spheres");
  EXPECT_EQ(fileCount(), 1U);
}

TEST_F(Tool, HelpTeachesWithExamples) {
  const ProgramResult help = run("--help");
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_NE(help.output.find("cairn build rock.obj -o rock.cairn"), std::string::npos);
  for (const char* command : {"build", "evaluate", "certify", "inspect", "export", "simplify"}) {
    const ProgramResult one = run(std::string(command) + " --help");
    EXPECT_EQ(one.exitCode, 0);
    EXPECT_NE(one.output.find(std::string("  cairn ") + command), std::string::npos) << command;
  }
}

TEST_F(Tool, BuildChecksTheOutputBeforeItWorks) {
  expectOneSentence(run("build " + quoted("rock.obj") + " -o " + quoted("no/rock.cairn")), 1, "does not exist");
  expectOneSentence(run("build " + quoted("rock.obj") + " -o '" + folder_.path().string() + "'"), 1, "it is a folder");
  expectOneSentence(build("--json " + quoted("no/report.json")), 1, "does not exist");
  EXPECT_EQ(fileCount(), 1U);
}

TEST_F(Tool, OutputsNeverReplaceInputsOrEachOther) {
  ASSERT_EQ(build("--no-evaluate").exitCode, 0);
  const std::string mesh = quoted("rock.obj"), tree = quoted("rock.cairn");
  const std::string meshBytes = test::contentOf(path("rock.obj")), treeBytes = test::contentOf(path("rock.cairn"));
  std::filesystem::create_hard_link(path("rock.obj"), path("link.obj"));
  std::filesystem::create_symlink("new.cairn", path("dangling"));
  const std::string indirect = "'" + path("") + "./rock.obj'";
  for (const std::string& arguments : {
           "build " + mesh + " -o " + mesh,
           "build " + mesh + " -o " + indirect,
           "build " + mesh + " -o " + quoted("link.obj"),
           "build " + mesh + " -o " + quoted("new.cairn") + " --json " + mesh,
           "build " + mesh + " -o " + quoted("new.cairn") + " --json " + quoted("./new.cairn"),
           "build " + mesh + " -o " + quoted("dangling") + " --json " + quoted("new.cairn"),
           "evaluate " + mesh + " " + tree + " --json " + tree,
           "certify " + mesh + " " + tree + " --json " + mesh,
           "inspect " + tree + " --json " + tree,
           "export " + tree + " --to sph -o " + tree,
           "simplify " + mesh + " -o " + mesh,
       }) {
    expectOneSentence(run(arguments), 1, "is the same file as");
    EXPECT_EQ(test::contentOf(path("rock.obj")), meshBytes) << arguments;
    EXPECT_EQ(test::contentOf(path("rock.cairn")), treeBytes) << arguments;
  }
  EXPECT_EQ(fileCount(), 4U);
}

TEST_F(Tool, AnOutputNeedsAName) {
  expectOneSentence(run("build " + quoted("rock.obj") + " -o ''"), 1, "name");
  EXPECT_EQ(fileCount(), 1U);
}

TEST_F(Tool, EvaluateRefusesATreeThatFailsItsCertificate) {
  ASSERT_EQ(build("--no-evaluate").exitCode, 0);
  test::writeText(path("other.obj"),
                  test::objText(test::moved(test::lumpyBall(5, 3), [](const Vec3d& v) { return v * 1.2; })));
  const ProgramResult result = run("evaluate " + quoted("other.obj") + " " + quoted("rock.cairn"));
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.output.find("NOT proven"), std::string::npos) << result.output;
  EXPECT_NE(result.errors.find("is not covered"), std::string::npos) << result.errors;
}

TEST_F(Tool, AReportThatCannotBeWrittenIsNoSuccess) {
  ASSERT_EQ(build("--no-evaluate").exitCode, 0);
  for (const std::string& arguments :
       {"inspect " + quoted("rock.cairn"), "certify " + quoted("rock.obj") + " " + quoted("rock.cairn"),
        std::string("--help")}) {
    const std::string closed = "'" CAIRN_TOOL "' " + arguments + " >&- 2>" + quoted("errors");
    const int status = std::system(closed.c_str());
    expectOneSentence({WEXITSTATUS(status), "", test::contentOf(path("errors"))}, 1, "standard output cannot be");
  }
}

TEST_F(Tool, ReportsOfAFinishedTreeHaveTheKeysScriptsRelyOn) {
  ASSERT_EQ(build("--no-evaluate").exitCode, 0);
  for (const char* command : {"evaluate ", "certify "}) {
    const ProgramResult result = run(command + quoted("rock.obj") + " " + quoted("rock.cairn") + " --json -");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const Json report = Json::parse(result.output);
    EXPECT_TRUE(report.at("build_cpu_s").is_null());
    EXPECT_TRUE(report.at("build_wall_s").is_null());
    EXPECT_GT(report.at("peak_rss_mb"), 1);
    EXPECT_GT(report.at("threads"), 0);
  }
}

TEST_F(Tool, SimplifyNamesTheFileInOneSentence) {
  test::writeText(path("torus.obj"), test::objText(test::torus(1, 0.3, 24, 12)));
  expectOneSentence(run("simplify " + quoted("torus.obj") + " -o " + quoted("out.foo")), 1, "ends in .obj");
  expectOneSentence(run("simplify " + quoted("torus.obj") + " --triangles 4 -o " + quoted("out.obj")), 1,
                    "torus.obj: ");
  EXPECT_FALSE(exists("out.obj"));
}

TEST_F(Tool, BadMeshesAreRefusedAndLeaveNothing) {
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const TriangleMesh cube = test::meshOf(test::cuboid({1, 1, 1}, 1));
  TriangleMesh twisted = cube;
  std::swap(twisted.triangles[7][0], twisted.triangles[7][1]);
  const TriangleMesh shifted = test::moved(cube, [](const Vec3d& v) { return v + Vec3d{0.5, 0.5, 0.5}; });
  const struct {
    std::string name, text, message;
  } cases[] = {
      {"empty.obj", "", "is empty"},
      {"unknown.xyzzy", "x", "not the extension of a mesh format"},
      {"index.obj", tetrahedron + "f 1 3 2\nf 1 2 9\n", "line 6: the face names vertex 9"},
      {"nan.obj", "v 0 nan 0\n", "line 1: the coordinate nan is not finite"},
      {"truncated.obj", tetrahedron + "f 1 3", "line 5: a face needs at least three vertices"},
      {"truncated.off", "OFF\n4 4 0\n0 0 0\n", "ends after 1 of 4 vertices"},
      {"open.obj", tetrahedron + "f 1 3 2\nf 1 2 4\nf 2 3 4\n", "the mesh is open: the edge"},
      {"twisted.obj", test::objText(twisted), "face opposite sides"},
      {"inside-out.obj", test::objText(test::flipped(cube)), "inside out"},
      {"flat.obj", tetrahedron + "f 1 2 3\nf 1 3 2\n", "flat"},
      {"crossing.obj", test::objText(test::joined(cube, shifted)), "intersect"},
  };
  for (const auto& c : cases) {
    test::writeText(path(c.name), c.text);
    const std::size_t before = fileCount();
    const ProgramResult result =
        run("build " + quoted(c.name) + " -o " + quoted("out.cairn") + " --json " + quoted("out.json"));
    expectOneSentence(result, 1, c.message);
    EXPECT_NE(result.errors.find(c.name), std::string::npos) << result.errors;
    EXPECT_EQ(fileCount(), before);
  }
  expectOneSentence(run("build " + quoted("missing.obj") + " -o " + quoted("out.cairn")), 1, "missing.obj");
}

TEST_F(Tool, BadTreesAreRefused) {
  test::writeText(path("garbage.cairn"), "this is no tree");
  expectOneSentence(run("inspect " + quoted("garbage.cairn")), 1, "garbage.cairn");
  expectOneSentence(run("inspect " + quoted("missing.cairn")), 1, "missing.cairn");
  ASSERT_EQ(build("--no-evaluate").exitCode, 0);
  std::string bytes = test::contentOf(path("rock.cairn"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  test::writeText(path("flipped.cairn"), bytes);
  expectOneSentence(run("certify " + quoted("rock.obj") + " " + quoted("flipped.cairn")), 1, "flipped.cairn");
}

TEST_F(Tool, AnInterruptedBuildLeavesNothingAndEndsWith130) {
  test::writeText(path("large.obj"), test::objText(test::lumpyBall(40, 3)));
  const std::vector<std::string> arguments = {
      "build",     path("large.obj"), "-o",     path("large.cairn"), "--depth", "5",
      "--samples", "200000",          "--json", path("large.json")};
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EQ(test::exitCodeAfterSignal(CAIRN_TOOL, arguments, signal, std::chrono::milliseconds(700)), 130);
    EXPECT_EQ(fileCount(), 2U);  // the two meshes
  }
}

TEST_F(Tool, ABuildInterruptedDuringItsEvaluationLeavesNothing) {
  // The octree of a small mesh takes a moment; its evaluation, with every sphere's samples, many times that.
  const std::vector<std::string> arguments = {
      "build", path("rock.obj"), "-o",     path("late.cairn"), "--method", "octree", "--depth",
      "6",     "--samples",      "100000", "--threads",        "1",        "--json", path("late.json")};
  for (const int delay : {400, 1000, 2000}) {
    EXPECT_EQ(test::exitCodeAfterSignal(CAIRN_TOOL, arguments, SIGINT, std::chrono::milliseconds(delay)), 130);
    EXPECT_EQ(fileCount(), 1U);
  }
}

TEST_F(Tool, AnInterruptedSimplifyLeavesNothingAndEndsWith130) {
  test::writeText(path("large.obj"), test::objText(test::lumpyBall(150, 3)));
  const std::vector<std::string> arguments = {"simplify", path("large.obj"), "-o", path("small.obj")};
  for (const int delay : {300, 1000}) {
    EXPECT_EQ(test::exitCodeAfterSignal(CAIRN_TOOL, arguments, SIGINT, std::chrono::milliseconds(delay)), 130);
    EXPECT_EQ(fileCount(), 2U);
  }
}

}  // namespace
}  // namespace cairn::builder::tool_test
