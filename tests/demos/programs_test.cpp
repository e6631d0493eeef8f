// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "run_program.h"
#include "scene_trees.h"

namespace cairn::test::programs_test {
namespace {

/// One line that begins with the program's name, ends with a full stop and holds `words`.
void expectOneSentence(const ProgramResult& result, const std::string& program, const std::string& words) {
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
  EXPECT_EQ(result.errors.rfind(program + ": ", 0), 0U) << result.errors;
  EXPECT_NE(result.errors.find(words), std::string::npos) << result.errors;
  EXPECT_TRUE(result.output.empty()) << result.output;
}

struct WrongUsage {
  const char* program;
  const char* arguments;
  const char* words;

  friend std::ostream& operator<<(std::ostream& out, const WrongUsage& usage) {
    return out << usage.program << ' ' << usage.arguments;
  }
};

class ProgramsWrongUsage : public ::testing::TestWithParam<WrongUsage> {};

TEST_P(ProgramsWrongUsage, IsOneSentenceAndExitCodeTwo) {
  const ProgramResult result = runProgram(GetParam().program, GetParam().arguments);
  EXPECT_EQ(result.exitCode, 2) << GetParam().arguments;
  expectOneSentence(result, GetParam().program, GetParam().words);
}
INSTANTIATE_TEST_SUITE_P(
    Demos, ProgramsWrongUsage,
    ::testing::Values(
        WrongUsage{"frame_budget", "--shape triangle",
                   "use tree, tree+triangles, tree+leaves, gimpact, hull, spheres, compound or fcl"},
        WrongUsage{"frame_budget", "--shape tree,", "there is no shape ''"},
        WrongUsage{"frame_budget", "--scene landslide", "use heap, crush, converge or rockfall"},
        WrongUsage{"frame_budget", "--scene heap,", "there is no scene ''"},
        WrongUsage{"frame_budget", "--scene rockfall --picture a.png", "use it with --scene heap or crush"},
        WrongUsage{"frame_budget", "--scene rockfall --viewer", "use it with --scene heap or crush"},
        WrongUsage{"frame_budget", "--budget-ops 10,20 --picture a.png", "--picture draws one run"},
        WrongUsage{"frame_budget", "--budget-ops 10,-20", "--budget-ops"},
        WrongUsage{"frame_budget", "--bodies 10,0", "--bodies"},
        WrongUsage{"frame_budget", "--priority round-robin,loudest", "there is no priority 'loudest'"},
        WrongUsage{"frame_budget", "--scene heap,crush --shape fcl", "has no scene it can answer"},
        WrongUsage{"frame_budget", "--shape tree,fcl", "use it with --scene converge"},
        WrongUsage{"frame_budget", "--scene crush --shape fcl", "use it with --scene converge"},
        WrongUsage{"frame_budget", "--runs 3", "--runs belongs to recorded poses"},
        WrongUsage{"frame_budget", "--scene crush --truth-every 5", "--truth-every belongs to"},
        WrongUsage{"frame_budget", "--meeting bounce", "--meeting belongs to recorded poses"},
        WrongUsage{"frame_budget", "--scene converge --meeting hug", "use through or bounce"},
        WrongUsage{"frame_budget", "--scene converge --truth-every 0", "--truth-every"},
        WrongUsage{"frame_budget", "--scene converge --picture a.png", "use it with --scene heap or crush"},
        WrongUsage{"frame_budget", "--scene converge --no-sleeping", "use it with --scene heap or crush"},
        WrongUsage{"frame_budget", "--budget-ops -5", "--budget-ops"},
        WrongUsage{"frame_budget", "--budget-us -0.5", "--budget-us"},
        WrongUsage{"frame_budget", "--budget-us nan", "--budget-us"},
        WrongUsage{"frame_budget", "--bodies 0", "--bodies"}, WrongUsage{"frame_budget", "--bodies 0x10", "--bodies"},
        WrongUsage{"frame_budget", "--bodies +5", "--bodies"},
        WrongUsage{"frame_budget", "--budget-us +100", "--budget-us"},
        WrongUsage{"frame_budget", "--budget-us 0x10", "--budget-us"},
        WrongUsage{"frame_budget", "--budget-us 1e400", "--budget-us"},
        WrongUsage{"frame_budget", "--margin-fraction +0.01", "--margin-fraction"},
        WrongUsage{"frame_budget", "--priority loudest", "use round-robin, two-class, worst-error or perceptual"},
        WrongUsage{"frame_budget", "--unresolved hope", "use guard, repel, ignore or compensate"},
        WrongUsage{"frame_budget", "--method magic", "magic"},
        WrongUsage{"frame_budget", "--tree a.cairn --mesh b.obj", "excludes"},
        WrongUsage{"frame_budget", "--speed 3", "--speed"}, WrongUsage{"rockfall", "", "subcommand"},
        WrongUsage{"rockfall", "run", "CASE"}, WrongUsage{"rockfall", "run a.json", "--output"},
        WrongUsage{"rockfall", "run a.json -o b --runs 5:5", "'5:5' is no range of runs: use a:b"},
        WrongUsage{"rockfall", "run a.json -o b --runs -1:5", "'-1:5' is no range of runs"},
        WrongUsage{"rockfall", "run a.json -o b --part 0/4", "'0/4' is no part: use i/n"},
        WrongUsage{"rockfall", "run a.json -o b --jobs 0", "--jobs"}, WrongUsage{"rockfall", "merge -o b", "DIR"},
        WrongUsage{"frame_budget", "--margin-fraction nan", "'nan' is not a fraction from 0 to 1"},
        WrongUsage{"make_rock", "--seed -1 -o rock.obj", "'-1' is not a whole number"},
        WrongUsage{"tree_picture", "", "TREE"}, WrongUsage{"debug_drawing", "", "TREE"}));

TEST(Programs_UnwritableOutput, IsNoticedBeforeTheWork) {
  const TemporaryFolder folder;
  const std::string nowhere = (folder.path() / "missing" / "file").string();
  // A million steps: whoever notices late does not come back in time.
  for (const auto& [program, arguments] :
       {std::pair<std::string, std::string>{"frame_budget", "--steps 1000000 --csv '" + nowhere + "'"},
        {"frame_budget", "--steps 1000000 --json '" + nowhere + "'"}}) {
    const ProgramResult result = runProgram(program, arguments);
    EXPECT_EQ(result.exitCode, 1) << arguments;
    expectOneSentence(result, program, "does not exist; create it first");
  }
}

TEST(Programs_Output, NeverReplacesAnInputOrAnother) {
  const TemporaryFolder folder;
  const std::string mesh = "'" + (folder.path() / "m.obj").string() + "'",
                    out = "'" + (folder.path() / "o").string() + "'";
  ASSERT_TRUE(writeFileAtomically(folder.path() / "m.obj", std::string_view("a mesh")));
  for (const std::string& arguments :
       {"--mesh " + mesh + " --json " + mesh, "--mesh " + mesh + " --csv " + mesh, "--json " + out + " --csv " + out}) {
    const ProgramResult result = runProgram("frame_budget", "--steps 1000000 " + arguments);
    EXPECT_EQ(result.exitCode, 1) << arguments;
    expectOneSentence(result, "frame_budget", "is the same file as");
  }
  EXPECT_EQ(contentOf((folder.path() / "m.obj").string()), "a mesh");
}

TEST(Programs_UnreadableInput, IsOneSentenceThatNamesTheFileAndExitCodeOne) {
  const TemporaryFolder folder;
  const std::string json = (folder.path() / "out.json").string();
  const ProgramResult mesh = runProgram("frame_budget", "--mesh no_such_mesh.obj --json '" + json + "'");
  EXPECT_EQ(mesh.exitCode, 1);
  expectOneSentence(mesh, "frame_budget", "no_such_mesh.obj");
  const ProgramResult tree = runProgram("frame_budget", "--tree no_such_tree.cairn --json '" + json + "'");
  EXPECT_EQ(tree.exitCode, 1);
  expectOneSentence(tree, "frame_budget", "no_such_tree.cairn");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  for (const char* program : {"tree_picture", "debug_drawing"}) {
    const ProgramResult picture = runProgram(program, "no_such_tree.cairn -o '" + json + "'");
    EXPECT_EQ(picture.exitCode, 1);
    expectOneSentence(picture, program, "no_such_tree.cairn");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Programs_Help, OfFrameBudgetShowsEverySceneByExample) {
  const ProgramResult result = runProgram("frame_budget", "--help");
  for (const char* example :
       {"--shape tree,gimpact --budget-ops 50000", "--scene converge --mesh", "--scene crush --mesh"})
    EXPECT_NE(result.output.find(example), std::string::npos) << example;
}

TEST(Programs_Help, ListsTheOptionsAndSucceeds) {
  for (const char* program : {"frame_budget", "rockfall", "tree_picture", "debug_drawing"}) {
    const ProgramResult result = runProgram(program, "--help");
    EXPECT_EQ(result.exitCode, 0) << program;
    EXPECT_NE(result.output.find("--"), std::string::npos) << program;
    EXPECT_TRUE(result.errors.empty()) << result.errors;
  }
}

class ProgramsWithATree : public ::testing::Test {
 protected:
  void SetUp() override {
    const Status saved = saveTree(*smallRockTree(), tree_);
    ASSERT_TRUE(saved) << saved.error().message;
  }
  std::string path(const char* name) const { return "'" + (folder_.path() / name).string() + "'"; }

  TemporaryFolder folder_;
  std::filesystem::path tree_ = folder_.path() / "rock.cairn";
};

TEST_F(ProgramsWithATree, RefusesALevelTheTreeDoesNotHave) {
  const ProgramResult result =
      runProgram("frame_budget", "--tree '" + tree_.string() + "' --shape spheres --spheres-level 8 --steps 1");
  EXPECT_EQ(result.exitCode, 1);
  expectOneSentence(result, "frame_budget", "the tree has no level 8: use 0 to ");
}

TEST_F(ProgramsWithATree, RefusesABudgetFromWhereAllPosesAreRecorded) {
  const ProgramResult result =
      runProgram("frame_budget", "--scene converge --tree '" + tree_.string() + "' --budget-from 5 --budget-ops 9");
  EXPECT_NE(result.exitCode, 0);
  expectOneSentence(result, "frame_budget", "--budget-from is for what begins in the air");
}

TEST_F(ProgramsWithATree, FrameBudgetWritesAnObjectForOneShapeAndAnArrayForSeveral) {
  const std::string common =
      "--scene heap --tree " + path("rock.cairn") + " --bodies 4 --steps 30 --budget-ops 2000 --seed 3 ";
  const ProgramResult one = runProgram("frame_budget", common + "--shape tree --json " + path("one.json"));
  ASSERT_EQ(one.exitCode, 0) << one.errors;
  const auto object = nlohmann::json::parse(contentOf(folder_.path() / "one.json"));
  EXPECT_EQ(object.at("scene"), "heap");
  EXPECT_EQ(object.at("shape"), "tree");
  EXPECT_EQ(object.at("bodies"), 4);
  EXPECT_EQ(object.at("steps"), 30);
  EXPECT_EQ(object.at("seed"), 3);
  EXPECT_EQ(object.at("mesh"), "rock-2");
  const ProgramResult several = runProgram("frame_budget", common + "--shape tree,hull --json " + path("two.json"));
  ASSERT_EQ(several.exitCode, 0) << several.errors;
  const auto array = nlohmann::json::parse(contentOf(folder_.path() / "two.json"));
  ASSERT_EQ(array.size(), 2U);
  EXPECT_EQ(array[0].at("state_hash"), object.at("state_hash"));
  EXPECT_EQ(array[1].at("shape"), "hull");
  EXPECT_NE(several.output.find("narrow phase / tree's"), std::string::npos) << several.output;
}

TEST_F(ProgramsWithATree, ConvergeShowsTheSamePosesToEveryShapeInEveryRunOfTheProgram) {
  const std::string common = "--scene converge --tree " + path("rock.cairn") +
                             " --bodies 6 --steps 150 --runs 2 --truth-every 10 --seed 3 --json ";
  const ProgramResult together = runProgram("frame_budget", common + path("both.json") + " --shape tree,gimpact");
  ASSERT_EQ(together.exitCode, 0) << together.errors;
  const ProgramResult alone = runProgram("frame_budget", common + path("hull.json") + " --shape hull");
  ASSERT_EQ(alone.exitCode, 0) << alone.errors;
  const auto both = nlohmann::json::parse(contentOf(folder_.path() / "both.json"));
  const auto hull = nlohmann::json::parse(contentOf(folder_.path() / "hull.json"));
  ASSERT_EQ(both.size(), 2U);
  for (const auto& run : both) {
    EXPECT_EQ(run.at("poses_hash"), hull.at("poses_hash"));
    EXPECT_EQ(run.at("true_pairs"), hull.at("true_pairs"));
    EXPECT_EQ(run.at("scene"), "converge");
    EXPECT_EQ(run.at("frames_checked"), 30);
  }
  EXPECT_TRUE(both[0].at("gap_end_fraction").at("mean").is_null()) << "nothing is simulated, and no key is missing";
  EXPECT_EQ(both[0].at("missed_beyond_certified_error"), 0);
  EXPECT_EQ(both[0].at("ratio_to_faster_exact_peer").at("peer"), "gimpact");
  for (const char* key : {"mean", "p99", "max"}) EXPECT_TRUE(hull.at("contact_error_fraction").at(key).is_number());
}

TEST_F(ProgramsWithATree, CrushPrintsItsStartItsEmptyStepAndItsCourse) {
  const ProgramResult result =
      runProgram("frame_budget", "--scene crush --tree " + path("rock.cairn") +
                                     " --bodies 5 --steps 120 --budget-us 500 --json " + path("crush.json"));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const auto json = nlohmann::json::parse(contentOf(folder_.path() / "crush.json"));
  EXPECT_GT(json.at("penetration_start_fraction").at("pairs"), 0);
  EXPECT_GT(json.at("empty_step_cpu_us"), 0);
  EXPECT_TRUE(json.at("narrow_phase_p999_over_allowance").is_number());
  // The slowest of its loops was not away from the processor for a tenth of the budget, and ends no earlier.
  const double allowed = 1.10 * 500 + json.at("empty_step_cpu_us").get<double>();
  EXPECT_GE(json.at("clock_loop_p999_over_allowance"), 0.9 * 500 / allowed);
  EXPECT_EQ(json.at("worst_penetration_fraction").size(), 9U);
  EXPECT_EQ(json.at("worst_penetration_fraction").at(0), json.at("penetration_start_fraction").at("max"));
  EXPECT_TRUE(json.at("gap_end_fraction").at("mean").is_number());
  EXPECT_NE(result.output.find("empty step, narrow phase"), std::string::npos);
}

TEST_F(ProgramsWithATree, ShapesOfMissingLibrariesAreRefusedByName) {
  const ProgramResult fcl = runProgram(
      "frame_budget", "--scene converge --runs 1 --steps 2 --bodies 2 --shape fcl --tree " + path("rock.cairn"));
  if (fcl.exitCode != 0) {
    EXPECT_EQ(fcl.exitCode, 1);
    expectOneSentence(fcl, "frame_budget", "install libfcl-dev");
  }
  const ProgramResult compound =
      runProgram("frame_budget", "--steps 2 --bodies 2 --shape compound --tree " + path("rock.cairn"));
  if (compound.exitCode != 0) {
    EXPECT_EQ(compound.exitCode, 1);
    expectOneSentence(compound, "frame_budget", "install libbullet-extras-dev");
  }
}

TEST_F(ProgramsWithATree, FrameBudgetReportsWhatAViewerSees) {
  const std::string common = "--tree " + path("rock.cairn") + " --bodies 8 --steps 60 --budget-ops 500 ";
  for (const std::string priority : {"round-robin", "two-class", "worst-error", "perceptual"}) {
    const ProgramResult result =
        runProgram("frame_budget", common + "--viewer --priority " + priority + " --json " + path("seen.json"));
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const auto json = nlohmann::json::parse(contentOf(folder_.path() / "seen.json"));
    EXPECT_EQ(json.at("priority"), priority);
    EXPECT_GT(json.at("seen_error_rad").at("max"), 0);
    EXPECT_NE(result.output.find("seen error"), std::string::npos) << result.output;
  }
  ASSERT_EQ(runProgram("frame_budget", common + "--json " + path("unseen.json")).exitCode, 0);
  const auto json = nlohmann::json::parse(contentOf(folder_.path() / "unseen.json"));
  EXPECT_TRUE(json.at("seen_error_rad").is_null()) << "nobody looks";
}

TEST_F(ProgramsWithATree, FrameBudgetLeavesNothingWhereItCannotWrite) {
  const ProgramResult result = runProgram(
      "frame_budget", "--tree " + path("rock.cairn") + " --bodies 1 --steps 1 --json " + path("missing/out.json"));
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.errors.find("out.json"), std::string::npos) << result.errors;
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "missing"));
}

TEST_F(ProgramsWithATree, PictureIsAPngOrOneSentenceWithoutPovray) {
  for (const char* program : {"tree_picture", "debug_drawing"}) {
    const ProgramResult drawn = runProgram(program, path("rock.cairn") + " -o " + path("tree.png"));
    if (drawn.exitCode == 0) {
      EXPECT_EQ(contentOf(folder_.path() / "tree.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
    } else {
      expectOneSentence(drawn, program, "install the package povray");
    }
    std::filesystem::remove(folder_.path() / "tree.png");
  }
  const std::string before = std::getenv("PATH");
  ASSERT_EQ(setenv("PATH", folder_.path().c_str(), 1), 0);
  const ProgramResult missing = runProgram("tree_picture", path("rock.cairn") + " -o " + path("tree.png"));
  ASSERT_EQ(setenv("PATH", before.c_str(), 1), 0);
  EXPECT_EQ(missing.exitCode, 1);
  expectOneSentence(missing, "tree_picture", "install the package povray");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "tree.png"));
}

TEST_F(ProgramsWithATree, PicturesGoWhereTheyAreToWhateverItIsCalled) {
  for (const char* name : {"two words", "an 'apostrophe", "\"quoted\"", "caf\u00e9", "-W10", "a;b$HOME"}) {
    const std::filesystem::path folder = folder_.path() / name, picture = folder / (std::string(name) + ".png");
    std::filesystem::create_directory(folder);
    ASSERT_EQ(setenv("CAIRN_PICTURE", picture.c_str(), 1), 0);
    const ProgramResult drawn = runProgram("tree_picture", path("rock.cairn") + " --width 200 -o \"$CAIRN_PICTURE\"");
    if (drawn.errors.find("install the package povray") != std::string::npos) GTEST_SKIP() << drawn.errors;
    EXPECT_EQ(drawn.exitCode, 0) << drawn.errors;
    EXPECT_EQ(contentOf(picture).substr(1, 3), "PNG") << name;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << "no file of another name: " << name;
  }
}

TEST_F(ProgramsWithATree, HelloBulletPrintsHeightsThatFall) {
  const ProgramResult result = runProgram("hello_bullet", path("rock.cairn"));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  std::vector<double> heights;
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t height = line.find("is ");
    ASSERT_NE(height, std::string::npos) << line;
    heights.push_back(std::stod(line.substr(height + 3)));
  }
  ASSERT_EQ(heights.size(), 11U);
  EXPECT_GT(heights.front(), 10);
  EXPECT_LT(heights.back(), 5);
  EXPECT_EQ(runProgram("hello_bullet", "").exitCode, 2);
  EXPECT_EQ(runProgram("hello_bullet", "no_such_tree.cairn").exitCode, 1);
}

}  // namespace
}  // namespace cairn::test::programs_test
