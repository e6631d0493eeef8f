// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>

#include "accuracy_cost/figures/draw.h"
#include "accuracy_cost/models/model.h"
#include "accuracy_cost/models/solids.h"
#include "cairn/builder/import.h"
#include "cairn/builder/simplify.h"
#include "cairn/core/atomic_file.h"
#include "interrupted_program.h"
#include "run_program.h"

namespace cairn::accuracy_cost::program_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Ordered = nlohmann::ordered_json;  // the program's: keys stay where they are
using test::contentOf;
using test::ProgramResult;

/// The program on one small solid, so that experiments take seconds.
class AccuracyCostProgram : public ::testing::Test {
 protected:
  AccuracyCostProgram() {
    fs::create_directories(path("meshes"));
    addMesh("cube", box({1, 1, 1}));
  }

  fs::path path(const std::string& name) const { return temporary_.path() / name; }
  void addMesh(const std::string& name, const builder::TriangleMesh& mesh) const {
    ASSERT_TRUE(writeFileAtomically(path("meshes/" + name + ".obj"), builder::objText(mesh)));
  }
  ProgramResult run(const std::string& experiment, const std::string& folder,
                    const std::string& rest = "--no-figures") const {
    return test::runProgram("accuracy_cost", "run " + experiment + " --quick --models '" + path("meshes").string() +
                                                 "' -o '" + path(folder).string() + "' " + rest);
  }

  test::TemporaryFolder temporary_;
};

TEST_F(AccuracyCostProgram, TakesOnlyMeshesFromAFolderEachNameOnce) {
  ASSERT_TRUE(writeFileAtomically(path("meshes/README.md"), "Where they are from.\n"));
  EXPECT_EQ(run("expand-selection", "out").exitCode, 0);
  const std::string cube = contentOf(path("meshes/cube.obj"));
  ASSERT_TRUE(writeFileAtomically(path("meshes/cube.a.obj"), cube));
  fs::copy_file(path("meshes/cube.obj"), path("meshes/cube.OBJ"));
  const ProgramResult twice = run("expand-selection", "twice");
  EXPECT_EQ(twice.exitCode, 1);
  EXPECT_NE(twice.errors.find("two meshes are called cube"), std::string::npos) << twice.errors;
  fs::create_directories(path("empty"));
  ASSERT_TRUE(writeFileAtomically(path("empty/README.md"), "Nothing here.\n"));
  const ProgramResult none = test::runProgram(
      "accuracy_cost", "run levels --models '" + path("empty").string() + "' -o '" + path("none").string() + "'");
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_NE(none.errors.find("empty holds no file of a mesh format"), std::string::npos) << none.errors;
}

TEST_F(AccuracyCostProgram, TellsForHowManySeedsEachClaimHolds) {
  const ProgramResult result = run("sampling", "out", "--no-figures --seed 3 --seeds 2");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_NE(result.output.find("sampling, of 2 seeds:"), std::string::npos);
  const json together = json::parse(contentOf(path("out/sampling-seeds.json")));
  EXPECT_EQ(together["seeds"], json::array({3, 4}));
  std::vector<int> holds(together["claims"].size());
  for (const char* seed : {"3", "4"}) {
    const json alone = json::parse(contentOf(path("out/seed-" + std::string(seed) + "/sampling.json")));
    ASSERT_EQ(alone["claims"].size(), holds.size());
    for (std::size_t i = 0; i < holds.size(); ++i) holds[i] += alone["claims"][i]["holds"].get<bool>() ? 1 : 0;
  }
  for (std::size_t i = 0; i < holds.size(); ++i) EXPECT_EQ(together["claims"][i]["holds_for_seeds"], holds[i]);
}

TEST_F(AccuracyCostProgram, WritesTheSameTableTwiceAndForAnyThreads) {
  for (const char* experiment : {"sampling", "expand-selection", "interruption"}) {
    const ProgramResult one = run(experiment, "one", "--no-figures --threads 1");
    ASSERT_EQ(one.exitCode, 0) << one.errors;
    const ProgramResult two = run(experiment, "two", "--no-figures --threads 2 --json");
    ASSERT_EQ(two.exitCode, 0) << two.errors;
    const std::string table = contentOf(path(std::string("one/") + experiment + ".csv"));
    EXPECT_GT(table.size(), 100U);
    EXPECT_EQ(table, contentOf(path(std::string("two/") + experiment + ".csv")));
    EXPECT_EQ(json::parse(two.output).at(0).at("experiment"), experiment);
  }
}

TEST_F(AccuracyCostProgram, WritesWhatTheReportReads) {
  ASSERT_EQ(run("expand-selection", "out", "--no-figures --seed 7").exitCode, 0);
  const json document = json::parse(contentOf(path("out/expand-selection.json")));
  for (const char* key : {"experiment", "thesis_section", "thesis_says", "we_found", "verdict", "why", "command",
                          "figures", "models", "seconds", "rule", "claims"})
    EXPECT_TRUE(document.contains(key)) << key;
  EXPECT_EQ(document["settings"]["seed"], 7);
  EXPECT_EQ(document["models"][0]["name"], "cube");
  EXPECT_NE(document["command"].get<std::string>().find("--seed 7"), std::string::npos);
}

TEST_F(AccuracyCostProgram, KeepsWhatIsThereAndMeasuresWhatChanged) {
  const auto csv = path("out/expand-selection.csv");
  // An old time of change tells whether the table was written again.
  const fs::file_time_type old = fs::file_time_type::clock::now() - std::chrono::hours(1);
  const auto isMeasured = [&](const std::string& rest) {
    if (fs::exists(csv)) fs::last_write_time(csv, old);
    const ProgramResult result = run("expand-selection", "out", "--no-figures" + rest);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_EQ(result.output.find("was there") == std::string::npos, fs::last_write_time(csv) != old);
    return fs::last_write_time(csv) != old;
  };
  EXPECT_TRUE(isMeasured(""));
  EXPECT_FALSE(isMeasured(""));
  EXPECT_TRUE(isMeasured(" --seed 2"));
  addMesh("cube", box({1, 1, 2}));
  EXPECT_TRUE(isMeasured(" --seed 2")) << "another mesh of that name";
  EXPECT_FALSE(isMeasured(" --seed 2"));
}

TEST_F(AccuracyCostProgram, MeasuresAgainWhatIsDamaged) {
  ASSERT_EQ(run("expand-selection", "out").exitCode, 0);
  const auto csv = path("out/expand-selection.csv"), file = path("out/expand-selection.json");
  const std::string table = contentOf(csv), document = contentOf(file);
  const auto isMadeAgain = [&](const std::string& what) {
    const ProgramResult result = run("expand-selection", "out");
    EXPECT_EQ(result.exitCode, 0) << what << ": " << result.errors;
    EXPECT_EQ(result.output.find("was there"), std::string::npos) << what;
    EXPECT_EQ(contentOf(csv), table) << what;
  };
  for (const std::string& damage :
       {table.substr(0, table.size() / 2), std::string(table.size(), '\0'), std::string()}) {
    ASSERT_TRUE(writeFileAtomically(csv, damage));
    isMadeAgain("a table of " + std::to_string(damage.size()) + " bytes");
  }
  for (const std::string damage : {"", "{", "null", "[]", R"({"sha256": 1})"}) {
    ASSERT_TRUE(writeFileAtomically(file, damage));
    isMadeAgain(damage);
  }
  for (const char* key : {"verdict", "seconds", "figures", "files", "settings", "claims", "sha256"})
    for (const Ordered& value : {Ordered(), Ordered(7), Ordered("text"), Ordered::object()}) {
      Ordered changed = Ordered::parse(document);
      changed[key] = value;
      ASSERT_TRUE(writeFileAtomically(file, changed.dump()));
      isMadeAgain(key);
    }
}

TEST_F(AccuracyCostProgram, DrawsAgainWhatIsDamagedOrGone) {
  if (const Status there = checkGnuplot(); !there) GTEST_SKIP() << there.error().message;
  ASSERT_EQ(run("expand-selection", "out", "").exitCode, 0);
  const auto svg = path("out/expand-selection.svg");
  const std::string drawn = contentOf(svg);
  for (const bool isGone : {true, false}) {
    if (isGone)
      fs::remove(svg);
    else
      ASSERT_TRUE(writeFileAtomically(svg, drawn.substr(0, 100)));
    const ProgramResult again = run("expand-selection", "out", "");
    ASSERT_EQ(again.exitCode, 0) << again.errors;
    EXPECT_NE(again.output.find("was there"), std::string::npos) << "nothing is measured";
    EXPECT_EQ(contentOf(svg).size(), drawn.size());
  }
}

TEST_F(AccuracyCostProgram, NamesModelsThatAreLeftOut) {
  const ProgramResult result = test::runProgram(
      "accuracy_cost", "run expand-selection --quick --archive /nosuch -o '" + path("out").string() + "' --no-figures");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const json document = json::parse(contentOf(path("out/expand-selection.json")));
  ASSERT_FALSE(document.at("left_out").empty());
  for (const json& name : document.at("left_out"))
    EXPECT_NE(result.errors.find(name.get<std::string>()), std::string::npos) << result.errors;
}

TEST_F(AccuracyCostProgram, DrawsFiguresOfATableThatIsThere) {
  if (const Status there = checkGnuplot(); !there) GTEST_SKIP() << there.error().message;
  ASSERT_EQ(run("expand-selection", "out").exitCode, 0);
  const std::string table = contentOf(path("out/expand-selection.csv"));
  const ProgramResult drawn = run("expand-selection", "out", "");
  ASSERT_EQ(drawn.exitCode, 0) << drawn.errors;
  EXPECT_NE(drawn.output.find("was there"), std::string::npos);
  EXPECT_EQ(contentOf(path("out/expand-selection.csv")), table);
  EXPECT_EQ(json::parse(contentOf(path("out/expand-selection.json"))).at("figures"),
            (json{"expand-selection.svg", "expand-selection.png"}));
  EXPECT_NE(contentOf(path("out/expand-selection.svg")).find("max-elim"), std::string::npos);
  EXPECT_EQ(contentOf(path("out/expand-selection.png")).substr(1, 3), "PNG");
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(path("out"))) ++files;
  EXPECT_EQ(files, 4U) << "nothing of the work is left over";
}

TEST_F(AccuracyCostProgram, NamesGnuplotWhereItIsMissing) {
  const std::string before = std::getenv("PATH");
  setenv("PATH", path("meshes").c_str(), 1);
  const ProgramResult refused = run("expand-selection", "out", "");
  const ProgramResult without = run("expand-selection", "out");
  setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_NE(refused.errors.find("gnuplot-nox"), std::string::npos) << refused.errors;
  EXPECT_EQ(without.exitCode, 0) << without.errors;
}

TEST_F(AccuracyCostProgram, RefusesInOneSentence) {
  const ProgramResult unknown = run("no-such", "out");
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_NE(unknown.errors.find("expand-selection"), std::string::npos) << "the names are listed";
  EXPECT_EQ(run("sampling", "out", "--seed -1").exitCode, 2);
  EXPECT_EQ(test::runProgram("accuracy_cost", "run sampling").exitCode, 2) << "no folder";

  ASSERT_TRUE(writeFileAtomically(path("meshes/open.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  const ProgramResult open = run("sampling", "out");
  EXPECT_EQ(open.exitCode, 1);
  EXPECT_NE(open.errors.find("open.obj"), std::string::npos) << open.errors;
  fs::remove(path("meshes/open.obj"));
  fs::remove(path("meshes/cube.obj"));
  EXPECT_EQ(run("sampling", "out").exitCode, 1) << "an empty folder";
  ASSERT_TRUE(writeFileAtomically(path("file"), ""));
  EXPECT_EQ(run("sampling", "file/below").exitCode, 1) << "no folder can be made";
}

TEST_F(AccuracyCostProgram, ListsAndMakesModels) {
  const ProgramResult list = test::runProgram("accuracy_cost", "list");
  EXPECT_EQ(list.exitCode, 0);
  for (const char* name : {"sampling", "expand-selection", "reductions", "levels", "balance", "interruption",
                           "error-against-time", "frame-time"})
    EXPECT_NE(list.output.find(name), std::string::npos) << name;
  const std::string made = " -o '" + path("made").string() + "'";
  for (const char* name : {"s-shape", "cube", "block", "cylinder", "cone", "torus"}) {
    const ProgramResult model = test::runProgram("accuracy_cost", std::string("models ") + name + made);
    EXPECT_EQ(model.exitCode, 0) << model.errors;
    EXPECT_TRUE(builder::importMesh(path("made") / (std::string(name) + ".obj"))) << name;
  }
  const ProgramResult scan = test::runProgram("accuracy_cost", "models bunny --archive /dev/null" + made);
  EXPECT_EQ(scan.exitCode, 1);
  EXPECT_NE(scan.errors.find("libcgal-demo"), std::string::npos) << scan.errors;
}

TEST_F(AccuracyCostProgram, IsCancelledWithoutAResult) {
  addMesh("torus", torus(1, 0.35, 40, 20));
  const std::string program = (fs::read_symlink("/proc/self/exe").parent_path() / "accuracy_cost").string();
  const std::vector<std::string> arguments{
      "run", "levels", "--models", path("meshes").string(), "-o", path("out").string(), "--no-figures"};
  EXPECT_EQ(test::exitCodeAfterSignal(program, arguments, SIGINT, std::chrono::milliseconds(700)), 130);
  EXPECT_FALSE(fs::exists(path("out/levels.json")));
  EXPECT_FALSE(fs::exists(path("out/levels.csv")));
}

}  // namespace
}  // namespace cairn::accuracy_cost::program_test
