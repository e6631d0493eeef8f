// SPDX-License-Identifier: GPL-3.0-or-later
// The comparison with a real experiment, on made-up data of the same layout.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "little_quarry.h"
#include "prepared_scene.h"
#include "rockfall/validation/calibrate.h"
#include "rockfall/validation/quarry_ground.h"

namespace cairn::rockfall::validation_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// The program's own settings, made cheap: coarser steps and trees, a search of five candidates.
json cheapSettings() {
  json document = builtInSettings().value().document;
  document["step_s"] = 0.01;
  document["duration_s"] = 6;
  document["tree_depth"] = 1;
  document["calibration"]["candidates"] = 2;
  document["calibration"]["rounds"] = 2;
  document["calibration"]["blocks"] = 6;
  return document;
}

class LittleQuarry : public ::testing::Test {
 protected:
  LittleQuarry() {
    test::writeLittleQuarry(data());
    std::ofstream(settingsFile()) << cheapSettings().dump();
  }

  fs::path data() const { return temporary_.path() / "data"; }
  fs::path settingsFile() const { return temporary_.path() / "settings.json"; }
  std::string quoted(const fs::path& path) const { return "'" + path.string() + "'"; }

  void write(const std::string& name, const std::string& text) const { std::ofstream(data() / name) << text; }
  std::string complaint() const {
    const auto read = readQuarry(data());
    return read ? std::string() : read.error().message;
  }

  QuarryScene prepared(const std::string& blocks = "measured") const {
    TreeCache cache(test::treeFolder());
    json settings = cheapSettings();
    settings["blocks"] = blocks;
    settings["drop_speed_m_per_s"] = 1.5;
    auto quarry = prepareQuarry(data(), settingsOf(settings, "settings.json").value(), cache);
    EXPECT_TRUE(quarry) << (quarry ? "" : quarry.error().message);
    return std::move(quarry).value();
  }

  test::ProgramResult validate(const std::string& rest) const {
    return test::runProgram("rockfall", "validate " + quoted(data()) + " --settings " + quoted(settingsFile()) +
                                            " --cache " + quoted(test::treeFolder()) + " " + rest);
  }

  test::TemporaryFolder temporary_;
};

TEST_F(LittleQuarry, IsReadAsItWasWritten) {
  const QuarryData read = readQuarry(data()).value();
  ASSERT_EQ(read.profiles.size(), 2U);
  EXPECT_EQ(read.orientations.size(), 4U);
  EXPECT_EQ(read.profiles[0].drops.size(), 2U);
  EXPECT_EQ(read.profiles[1].drops.size(), 2U) << "an empty line is none";
  ASSERT_EQ(read.profiles[0].blocks.size(), 6U);
  EXPECT_EQ(read.profiles[0].blocks[1].stop.x, 22);
  EXPECT_EQ(read.profiles[0].blocks[1].stop.y, -1) << "the data's z runs against the map's y";
  EXPECT_EQ(read.profiles[0].blocks[1].stop.z, 88.9);
  EXPECT_EQ(read.profiles[0].published.size(), 4U);
  EXPECT_TRUE(read.profiles[1].blocks.empty());
}

TEST_F(LittleQuarry, IsRefusedWithFileAndLine) {
  const auto refused = [&](const char* file, const char* text, const char* why) {
    const std::string kept = test::contentOf(data() / file);
    write(file, text);
    const std::string said = complaint();
    EXPECT_NE(said.find(file), std::string::npos) << said;
    EXPECT_NE(said.find(why), std::string::npos) << said;
    write(file, kept);
  };
  EXPECT_EQ(complaint(), "");
  refused("Endpoints_P1.txt", "1 2 3 4 1 1 1\n1 nan 3 4 1 1 1\n", "line 2: 'nan' is not a finite number");
  refused("Endpoints_P1.txt", "1 2 3 -4 1 1 1\n", "mass of -4 kg");
  refused("Endpoints_P1.txt", "1 2 3 4 1 2 1\n", "must not rise");
  refused("Endpoints_P1.txt", "1 2 3 4\n", "has 4 columns where 7 belong");
  refused("Endpoints_P1.txt", "1e300 2 3 4 1 1 1\n", "farther than");
  refused("positions_P2.xyz", "\n\n", "is empty");
  refused("orientations.txt", "q0 q1 q2 q3\n1 1 0 0\n", "no orientation");
  refused("orientations.txt", "q0 q1 q2 q3\n", "has no orientations");
  refused("rockable_P1.csv", "names\nSP1A,1,1,19,1,2,3,1e9\n", "a speed of 1e+09 m/s");
  fs::remove(data() / "positions_P1.xyz");
  EXPECT_NE(complaint().find("positions_P1.xyz"), std::string::npos);
}

TEST_F(LittleQuarry, HasItsGroundWhereItsMeshesAre) {
  const QuarryScene quarry = prepared();
  const Ground& ground = *quarry.scene.ground;
  for (const double x : {0.3, 7.1, 25.2, 55.7})
    EXPECT_NEAR(ground.heightAt({x, -3.2}), test::littleHeight(x), 1e-3) << x;
  const Materials& materials = quarry.scene.description.materials;
  EXPECT_EQ(materials[ground.materialAt({10, 0})], "blue");
  EXPECT_EQ(materials[ground.materialAt({35, 4})], "gray");
  EXPECT_EQ(materials[ground.materialAt({55, -4})], "red");
}

/// q v q* for a unit quaternion, the real part first.
Vec3d turned(const std::array<double, 4>& q, const Vec3d& v) {
  const Vec3d u(q[1], q[2], q[3]), t = cross(u, v) * 2.0;
  return v + t * q[0] + cross(u, t);
}

// A point of a scan is where the data's own frame has it: turned by the quaternion, moved to the place, and then seen
// with z up.
TEST_F(LittleQuarry, ReleasesBlocksAsTheDataSay) {
  const QuarryScene quarry = prepared("scans");
  const std::vector<BlockRun> runs = runsOf(quarry, 1);
  ASSERT_EQ(runs.size(), 4U * 2 * 4);
  for (const BlockRun& run : runs) {
    const ReleasedRock rock = releaseOf(quarry, run);
    const SphereTree& tree = *quarry.scene.stock.groups[quarry.blocks[run.block].scan].front().tree;
    const Vec3d drop = quarry.data.profiles[1].drops[run.drop];
    for (const Vec3& vertex : tree.vertices()) {
      const Vec3d fromCenter = Vec3d(vertex) + tree.origin() - tree.mass().centerOfMass;
      const Vec3d inBody = transpose(tree.mass().principalAxes) * fromCenter;
      const btVector3 place = rock.pose * btVector3(btScalar(inBody.x), btScalar(inBody.y), btScalar(inBody.z));
      const Vec3d expected = fromData(turned(quarry.data.orientations[run.orientation], fromCenter)) + drop;
      // Places 100 m up are told to 4 micrometres.
      EXPECT_NEAR(double(place.x()), expected.x, 2e-5);
      EXPECT_NEAR(double(place.y()), expected.y, 2e-5);
      EXPECT_NEAR(double(place.z()), expected.z, 2e-5);
    }
  }
  const ReleasedRock largest = releaseOf(quarry, runs[2 * 8]);
  EXPECT_NEAR(largest.massKg, 2600 * 1.4 * 1.1 * 0.8, 1) << "as large as it was scanned";
  EXPECT_EQ(largest.velocity, btVector3(1.5, 0, 0));
}

// Scans' boxes are 0.8 x 0.6 x 0.5, 1.2 x 0.9 x 0.7, 1.4 x 1.1 x 0.8 and 1.2 x 0.6 x 0.4 m.
TEST_F(LittleQuarry, GivesEachMeasuredBlockTheScanOfItsProportionsAtItsMass) {
  const QuarryScene quarry = prepared();
  ASSERT_EQ(quarry.blocks.size(), quarry.data.profiles[0].blocks.size());
  const std::vector<std::size_t> expected{2, 2, 2, 1, 2, 0};
  for (std::size_t i = 0; i < quarry.blocks.size(); ++i) {
    const Block& block = quarry.blocks[i];
    EXPECT_EQ(block.scan, expected[i]) << i;
    EXPECT_EQ(block.massKg, quarry.data.profiles[0].blocks[i].massKg);
    const RockShape& shape = quarry.scene.stock.groups[block.scan].front();
    EXPECT_NEAR(2600 * shape.volume * std::pow(block.sieveM, 3), block.massKg, 1e-6 * block.massKg) << i;
  }
  for (const std::size_t profile : {0, 1}) {
    const std::vector<BlockRun> runs = runsOf(quarry, profile);
    EXPECT_EQ(runs.size(), 6U * 2 * 4) << "both slopes get the blocks of the first";
    EXPECT_EQ(releaseOf(quarry, runs.back()).massKg, quarry.blocks.back().massKg);
  }
}

// Of many blocks every n-th orientation falls, and together they use all of them.
TEST_F(LittleQuarry, LetsAboutAsManyBlocksFallAsWerePublished) {
  QuarryScene quarry = prepared();
  quarry.blocks.resize(500);
  const std::vector<BlockRun> runs = runsOf(quarry, 0);
  EXPECT_GT(runs.size(), 900U);
  EXPECT_LE(runs.size(), 1100U);
  for (std::size_t orientation = 0; orientation < quarry.data.orientations.size(); ++orientation)
    EXPECT_GT(std::ranges::count(runs, orientation, &BlockRun::orientation), 200) << orientation;
}

TEST_F(LittleQuarry, IsComparedWithWhatWasMeasured) {
  const auto one = temporary_.path() / "one.json", three = temporary_.path() / "three.json";
  const auto figure = temporary_.path() / "figure.svg";
  const test::ProgramResult result = validate("--json " + quoted(one) + " --figure " + quoted(figure));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_NE(result.output.find("P1, the slope that calibration uses"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("P2, which calibration never sees"), std::string::npos);
  EXPECT_NE(result.output.find("nothing to compare with"), std::string::npos);
  const json told = json::parse(test::contentOf(one));
  const json& runout = told.at("profiles").at(0).at("runout");
  EXPECT_EQ(runout.at("simulated").at("blocks"), 48);
  EXPECT_NEAR(runout.at("measured").at("p50_m").get<double>(), 24 - test::kLittleDropX, 1e-9);
  EXPECT_EQ(runout.at("published").at("blocks"), 4);
  const double reached = runout.at("simulated").at("p95_m").get<double>();
  EXPECT_GT(reached, 1) << "blocks went down the slope";
  EXPECT_TRUE(runout.at("simulated").at("against_measured").contains("wasserstein_m"));
  EXPECT_FALSE(told.at("profiles").at(1).at("runout").at("simulated").contains("against_measured"));
  EXPECT_NE(test::contentOf(figure).find("<svg"), std::string::npos);

  ASSERT_EQ(validate("--jobs 3 --json " + quoted(three)).exitCode, 0);
  EXPECT_EQ(test::contentOf(one), test::contentOf(three)) << "any number of processes";
}

TEST_F(LittleQuarry, IsCalibratedByItsFirstProfileAlone) {
  QuarryScene quarry = prepared();
  const ValidationSettings settings = settingsOf(cheapSettings(), "settings.json").value();
  const Calibration found = calibrate(quarry, settings, 2).value();
  ASSERT_EQ(found.trials.size(), 5U);
  EXPECT_EQ(found.trials[0].values, valuesOf(settings));
  for (const Trial& trial : found.trials) {
    EXPECT_GE(trial.misfit, found.trials[found.best].misfit);
    for (std::size_t i = 0; i < trial.values.size(); ++i) {
      const auto [low, high] = settings.calibration.parameters[i].range;
      EXPECT_TRUE(trial.values[i] >= low && trial.values[i] <= high) << settings.calibration.parameters[i].name;
    }
  }
  // The second profile decides nothing.
  write("Endpoints_P2.txt", "30 88.9 0 800 1 0.8 0.6\n");
  write("positions_P2.xyz", "2 105 3\n");
  QuarryScene other = prepared();
  const Calibration again = calibrate(other, settings, 1).value();
  ASSERT_EQ(again.trials.size(), found.trials.size());
  for (std::size_t i = 0; i < found.trials.size(); ++i) EXPECT_EQ(again.trials[i].misfit, found.trials[i].misfit);
}

TEST_F(LittleQuarry, KeepsWhatItFoundInAFileOfSettings) {
  const auto found = temporary_.path() / "found.json", after = temporary_.path() / "after.json",
             again = temporary_.path() / "again.json";
  const test::ProgramResult result = validate("--calibrate " + quoted(found) + " --json " + quoted(after));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_NE(result.output.find("calibrated on P1: seed 7, 2 rounds of 2 candidates, 6 blocks each"), std::string::npos)
      << result.output;
  fs::copy_file(found, settingsFile(), fs::copy_options::overwrite_existing);
  ASSERT_EQ(validate("--json " + quoted(again)).exitCode, 0);
  EXPECT_EQ(test::contentOf(after), test::contentOf(again));
}

TEST_F(LittleQuarry, RefusesWhatItCannotCompare) {
  write("positions_P1.xyz", "2 120 0\n2 50 0\n");
  const test::ProgramResult below = validate("");
  EXPECT_EQ(below.exitCode, 1);
  EXPECT_NE(below.errors.find("positions_P1.xyz, line 2: the place (2, 50, 0) is "), std::string::npos) << below.errors;
  EXPECT_NE(below.errors.find(" m below the ground, whose y there is "), std::string::npos) << below.errors;
  write("positions_P1.xyz", "\n2000 90 0\n");
  const test::ProgramResult beside = validate("");
  EXPECT_NE(
      beside.errors.find("positions_P1.xyz, line 2: the place (2000, 90, 0) has no ground below it; the ground lies "
                         "between x "),
      std::string::npos)
      << beside.errors;
  test::writeLittleQuarry(data());
  fs::remove(data() / "Endpoints_P1.txt");
  EXPECT_NE(validate("").errors.find("set \"blocks\" to \"scans\""), std::string::npos);
  json scans = cheapSettings();
  scans["blocks"] = "scans";
  std::ofstream(settingsFile()) << scans.dump();
  EXPECT_EQ(validate("--every 8").exitCode, 0);
  const auto found = temporary_.path() / "found.json";
  const test::ProgramResult unmeasured = validate("--calibrate " + quoted(found));
  EXPECT_EQ(unmeasured.exitCode, 1);
  EXPECT_NE(unmeasured.errors.find("add Endpoints_P1.txt"), std::string::npos) << unmeasured.errors;
  EXPECT_FALSE(fs::exists(found));
}

TEST(ValidationSettings_Refused, WithThePlace) {
  const auto complaint = [](const auto& change) {
    json document = cheapSettings();
    change(document);
    const auto read = settingsOf(document, "s.json");
    return read ? std::string() : read.error().message;
  };
  EXPECT_EQ(complaint([](json&) {}), "");
  EXPECT_NE(complaint([](json& d) { d["step_s"] = -1; }).find("/step_s"), std::string::npos);
  EXPECT_NE(complaint([](json& d) { d["stepps"] = 1; }).find("/stepps"), std::string::npos);
  EXPECT_NE(complaint([](json& d) { d["blocks"] = "all"; }).find("/blocks"), std::string::npos);
  EXPECT_NE(complaint([](json& d) { d["drop_speed_m_per_s"] = -1; }).find("/drop_speed"), std::string::npos);
  json& (*first)(json&) = [](json& d) -> json& { return d["calibration"]["parameters"][0]; };
  EXPECT_NE(complaint([&](json& d) { first(d)["at"][0] = "/effects/99/value"; }).find("/at/0"), std::string::npos);
  EXPECT_NE(complaint([&](json& d) { first(d)["at"][0] = "/density_kg_per_m3"; }).find("can be calibrated"),
            std::string::npos);
  EXPECT_NE(complaint([](json& d) { d["density_kg_per_m3"] = 2.6; }).find("/density_kg_per_m3"), std::string::npos);
  EXPECT_NE(complaint([&](json& d) { first(d)["at"][0] = "no pointer"; }).find("/at/0"), std::string::npos);
  EXPECT_NE(complaint([&](json& d) { first(d)["range"] = {2, 1}; }).find("/range"), std::string::npos);
}

// Only outside a user's clone the published data may be there.
TEST(AuthumeData, AreReadWhereTheyAre) {
  const fs::path folder = fs::path(CAIRN_VALIDATION_DATA) / "authume";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not here: the published data are not part of the sources";
  const auto read = readQuarry(folder);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read.value().profiles[0].blocks.size(), 41U);
  EXPECT_EQ(read.value().profiles[0].published.size(), 4U * 4 * 64);
  EXPECT_EQ(read.value().orientations.size(), 64U);
  const ValidationSettings settings = builtInSettings().value();
  const auto ground = readQuarryGround(folder, settings.cellM, settings.materials);
  ASSERT_TRUE(ground) << ground.error().message;
  for (MaterialId material = 1; material < settings.materials.size(); ++material)
    EXPECT_GT(std::ranges::count(ground.value().section.grid.materials, material), 500) << settings.materials[material];
}

}  // namespace
}  // namespace cairn::rockfall::validation_test
