// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "prepared_scene.h"
#include "rockfall/simulation/release.h"
#include "rockfall/simulation/run.h"
#include "rockfall/simulation/run_seed.h"
#include "scenes/bodies/model.h"

namespace cairn::rockfall::simulation_test {
namespace {

using nlohmann::json;

constexpr double kGravity = 9.81;

TEST(RunSeeds_OfTenThousandRuns, AreAllDifferentInEveryFamily) {
  std::set<std::uint64_t> seeds;
  constexpr std::array kFamilies{Variable::variant, Variable::size, Variable::place, Variable::orientation,
                                 Variable::effects};
  for (std::uint64_t run = 0; run < 10000; ++run)
    for (const Variable family : kFamilies) seeds.insert(seedOf(7, "slope", run, family));
  EXPECT_EQ(seeds.size(), 50000U);
  EXPECT_EQ(seedOf(7, "slope", 3, Variable::place), seedOf(7, "slope", 3, Variable::place));
  EXPECT_NE(seedOf(8, "slope", 3, Variable::place), seedOf(7, "slope", 3, Variable::place));
  EXPECT_NE(seedOf(7, "slopf", 3, Variable::place), seedOf(7, "slope", 3, Variable::place));
}

// The run goes on for the second rock, and until both have been still for half a second.
TEST(RocksThatRest, EndWhenTheyCameToRest) {
  json document = test::plainCase();
  document["terrain"]["slope_deg"] = 0;
  document["duration_s"] = 30;
  document["rocks"][0]["release"]["interval_s"] = 8;
  document["effects"].push_back(
      {{"effect", "sleeping"}, {"linear_m_per_s", 0.3}, {"angular_rad_per_s", 0.3}, {"after_s", 0.5}});
  const auto finished = simulate(test::prepared(document), 0);
  ASSERT_TRUE(finished) << finished.error().message;
  const RunResult& result = finished.value().result;
  const double stepS = document["step_s"], end = static_cast<double>(result.steps) * stepS;
  ASSERT_EQ(result.rocks.size(), 2U);
  for (const RockRecord& rock : result.rocks) {
    EXPECT_EQ(rock.ending, RockEnd::resting);
    EXPECT_GT(rock.endS, rock.releaseS + std::sqrt(2 * 0.9 / kGravity)) << "it falls almost a metre first";
    EXPECT_LT(rock.endS, end - 0.5 + 2 * stepS);
  }
  EXPECT_LT(result.rocks[0].endS, 8);
  EXPECT_EQ(result.rocks[1].releaseS, 8);
}

TEST(RocksThatWouldBeReleasedAfterTheEnd, AreRefused) {
  json document = test::plainCase();  // of two rocks and 4 s
  const auto prepared = [&](double intervalS) {
    document["rocks"][0]["release"]["interval_s"] = intervalS;
    TreeCache cache(test::treeFolder());
    return prepareScene(test::readJson(document).value(), cache);
  };
  EXPECT_TRUE(prepared(3.99));
  const auto late = prepared(4);
  ASSERT_FALSE(late);
  EXPECT_NE(late.error().message.find("/rocks/0/release: the last of its 2 rocks is due at 4 s"), std::string::npos)
      << late.error().message;
  document["rocks"][0]["count"] = 1;
  EXPECT_TRUE(prepared(4));
}

// Seven metres a second are seven centimetres a step.
TEST(CellsOfARock, LieOneBesideTheOther) {
  json document = test::plainCase();
  document["outputs"]["raster_cell_m"] = 0.02;
  const RunResult result = simulate(test::prepared(document), 0).value().result;
  std::set<std::tuple<std::uint32_t, std::int32_t, std::int32_t>> cells;
  for (const VisitRecord& visit : result.cells) cells.emplace(visit.rock, visit.column, visit.row);
  EXPECT_GT(cells.size(), 500U);
  for (const auto& [rock, column, row] : cells)
    EXPECT_TRUE(cells.contains({rock, column - 1, row}) || cells.contains({rock, column + 1, row}) ||
                cells.contains({rock, column, row - 1}) || cells.contains({rock, column, row + 1}))
        << column << ", " << row;
}

TEST(Ground_OfEveryGenerator, HasTheHeightsItsParametersSay) {
  json document = test::plainCase();
  const auto groundOf = [&](const char* terrain) {
    document["terrain"] = json::parse(terrain);
    return makeGround(test::readJson(document).value()).value();
  };
  const double slope = std::tan(30 * 3.14159265358979 / 180);
  // Heights below 32 m and the slope are rounded to float: by 2^-20 m, and by 2^-25 of one over 40 m.
  constexpr double kTolerance = 4e-6;
  const auto plane =
      groundOf(R"({"generated": "plane", "length_m": 40, "width_m": 20, "slope_deg": 30, "material": "soil"})");
  EXPECT_NEAR(plane->heightAt({10.3, -2.7}), 29.7 * slope, kTolerance);
  EXPECT_NEAR(plane->normalAt({10.3, -2.7}).z, std::cos(30 * 3.14159265358979 / 180), kTolerance);
  EXPECT_FALSE(plane->covers({-0.1, 0}));
  EXPECT_FALSE(plane->covers({40.1, 0}));
  const auto steps = groundOf(
      R"({"generated": "stepped_slope", "profile_m": [[0, 9], [4, 8], [6, 1], [10, 1]], "width_m": 6, "bank_m": 5,
          "cell_m": 0.5, "material": "soil"})");
  EXPECT_NEAR(steps->heightAt({2, 0}), 8.5, kTolerance);
  EXPECT_NEAR(steps->heightAt({5, 2}), 4.5, kTolerance);
  EXPECT_NEAR(steps->heightAt({8, 4.2}), 6, kTolerance) << "on the bank";
  const auto channel = groundOf(
      R"({"generated": "channel", "length_m": 40, "width_m": 20, "slope_deg": 30, "depth_m": 5, "material": "soil"})");
  EXPECT_NEAR(channel->heightAt({10, 0}), 30 * slope, kTolerance);
  EXPECT_NEAR(channel->heightAt({10, -6}), 30 * slope + 5 * 0.36, kTolerance);
  const auto cone =
      groundOf(R"({"generated": "talus_cone", "height_m": 10, "slope_deg": 30, "width_m": 60, "material": "soil"})");
  EXPECT_NEAR(cone->heightAt({3, 4}), 10 - 5 * slope, kTolerance);
  EXPECT_NEAR(cone->heightAt({20, 20}), 0, kTolerance);
}

TEST(Ground_TooManyPoints, AreRefused) {
  json document = test::plainCase();
  document["terrain"]["length_m"] = 1e5;
  document["terrain"]["cell_m"] = 0.01;
  const auto ground = makeGround(test::readJson(document).value());
  ASSERT_FALSE(ground);
  EXPECT_NE(ground.error().message.find("use a larger cell_m"), std::string::npos);
}

TEST(Scene_AReleaseBeyondTheGround, IsRefusedWithItsPath) {
  json document = test::plainCase();
  document["rocks"][0]["release"]["box_m"] = {{3, -3}, {60, 3}};
  TreeCache cache(test::treeFolder());
  const auto scene = prepareScene(test::readJson(document).value(), cache);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message.rfind("/rocks/0/release/box_m: the corner (60, 3) is not over the ground", 0), 0U)
      << scene.error().message;
}

TEST(Scene_ARasterOfTooManyCells, IsRefusedWithItsPath) {
  json document = test::plainCase();
  document["terrain"] = {{"generated", "plane"}, {"length_m", 9000}, {"width_m", 800},
                         {"slope_deg", 20},      {"cell_m", 100},    {"material", "soil"}};
  document["outputs"]["raster_cell_m"] = 0.3;
  TreeCache cache(test::treeFolder());
  const auto scene = prepareScene(test::readJson(document).value(), cache);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message,
            "/outputs/raster_cell_m: rasters would have 80 million cells, more than 64 million: use larger ones");
}

TEST(Release_OfManyRocks, LeavesThemApartInTheirBox) {
  json document = test::plainCase();
  document["rocks"][0]["count"] = 60;
  const Scene scene = test::prepared(document);
  const auto rocks = releaseRocks(scene, 5);
  ASSERT_EQ(rocks.size(), 60U);
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    const Vec3d place = scenes::fromBullet(rocks[i].pose.getOrigin());
    EXPECT_TRUE(place.x >= 3 && place.x <= 6 && place.y >= -3 && place.y <= 3);
    EXPECT_GT(place.z, scene.ground->heightAt({place.x, place.y}) + 1 + rocks[i].reachM);
    EXPECT_TRUE(rocks[i].sieveM >= 0.4 && rocks[i].sieveM <= 0.8);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(distance(place, scenes::fromBullet(rocks[j].pose.getOrigin())), rocks[i].reachM + rocks[j].reachM);
  }
}

// At the foot of a wall a ball over a point's own slope would lie in the wall.
TEST(Release_BesideAWall, LeavesNoGroundInARock) {
  json document = test::plainCase();
  document["terrain"] = {{"generated", "stepped_slope"},
                         {"profile_m", {{0, 8}, {10, 8}, {10.5, 0}, {40, 0}}},
                         {"width_m", 20},
                         {"cell_m", 0.25},
                         {"roughness_m", 0},
                         {"material", "soil"}};
  document["rocks"][0]["count"] = 20;
  document["rocks"][0]["release"] = {{"box_m", {{10.6, -5}, {12, 5}}}, {"above_ground_m", 0}};
  const Scene scene = test::prepared(document);
  const MapPoint& origin = scene.worldOrigin;
  for (const ReleasedRock& rock : releaseRocks(scene, 1)) {
    const Vec3d middle = scenes::fromBullet(rock.pose.getOrigin());
    // Heights are looked at a quarter of the reach apart.
    const double radius = 0.7 * rock.reachM;
    constexpr int kLooks = 40;
    for (int i = -kLooks; i <= kLooks; ++i)
      for (int j = -kLooks; j <= kLooks; ++j) {
        const double x = radius * i / kLooks, y = radius * j / kLooks, below = radius * radius - x * x - y * y;
        if (below >= 0)
          ASSERT_LE(scene.ground->heightAt({middle.x + x, middle.y + y}), middle.z - std::sqrt(below))
              << middle.x + origin[0] << " reach " << rock.reachM;
      }
  }
}

TEST(Release_AnotherRun, DrawsOtherNumbers) {
  const Scene scene = test::prepared(test::plainCase());
  const auto first = releaseRocks(scene, 1), second = releaseRocks(scene, 2);
  EXPECT_NE(first[0].sieveM, second[0].sieveM);
  EXPECT_EQ(releaseRocks(scene, 1)[0].sieveM, first[0].sieveM);
}

TEST(Run_SameNumber, GivesTheSameBitsAndAnotherDoesNot) {
  const Scene scene = test::prepared(test::plainCase());
  const std::string hash = simulate(scene, 3).value().result.stateHash;
  EXPECT_EQ(simulate(scene, 3).value().result.stateHash, hash);
  EXPECT_NE(simulate(scene, 4).value().result.stateHash, hash);
}

/// A rock thrown over flat ground: its parabola is known.
json throwCase() {
  json document = test::plainCase();
  document["terrain"] = {
      {"generated", "plane"}, {"length_m", 60}, {"width_m", 20}, {"slope_deg", 0}, {"material", "soil"}};
  document["rocks"][0]["count"] = 1;
  document["rocks"][0]["release"] = {
      {"box_m", {{2, 0}, {2, 0}}}, {"above_ground_m", 40}, {"velocity_m_per_s", {10, 0, 0}}};
  document["duration_s"] = 2;
  return document;
}

TEST(Run_CrossingACollector, MeasuresTheParabola) {
  const Scene scene = test::prepared(throwCase());
  const RunResult result = simulate(scene, 0).value().result;
  ASSERT_EQ(result.crossings.size(), 1U);
  const CrossingRecord& crossing = result.crossings[0];
  // 18 m at 10 m/s.
  const double time = 1.8, start = result.rocks[0].start.z;
  EXPECT_NEAR(crossing.timeS, time, 1e-4);
  EXPECT_EQ(crossing.direction, 1) << "down the slope is to the right of a line along +y";
  EXPECT_NEAR(crossing.alongM, 10, 1e-4);
  // Bullet's steps are semi-implicit: they fall g t dt / 2 deeper than the parabola; between two steps, a chord: g dt^2
  // / 8.
  const double dt = 0.01, fallen = kGravity * time * time / 2 + kGravity * time * dt / 2;
  EXPECT_NEAR(crossing.heightM, start - fallen, 2e-3);
  EXPECT_NEAR(crossing.speed, std::hypot(10, kGravity * time), 1e-3 * crossing.speed);
  EXPECT_NEAR(crossing.energyJ, 0.5 * result.rocks[0].massKg * crossing.speed * crossing.speed,
              1e-3 * crossing.energyJ);
}

TEST(Run_ASecondOfFall, IsSampledVisitedAndMeasured) {
  json document = throwCase();
  document["duration_s"] = 1;
  const Scene scene = test::prepared(document);
  const RunResult result = simulate(scene, 0).value().result;
  ASSERT_EQ(result.trajectories.size(), 1U);
  EXPECT_EQ(result.trajectories[0].size(), 11U) << "every tenth of a second, both ends";
  EXPECT_EQ(result.cells.size(), 11U) << "from x = 2 to 12 m, a metre each";
  EXPECT_EQ(result.distances.size(), 11U);
  EXPECT_EQ(result.rocks[0].ending, RockEnd::moving);
  // Single precision over ten metres.
  EXPECT_NEAR(result.rocks[0].runoutM(), 10, 1e-4);
  EXPECT_EQ(result.rocks[0].impacts, 0U);
  // Thrown level at 10 m/s without spin: in the last whole metre it has fallen for a second less what is left of it.
  const VisitRecord& last = result.cells[9];
  EXPECT_NEAR(last.maxSpeed, std::hypot(10, kGravity), 0.1);
  const double ofSpeed = result.rocks[0].massKg * last.maxSpeed * last.maxSpeed / 2;
  EXPECT_NEAR(last.maxTranslationJ, ofSpeed, 1e-6 * ofSpeed);
  EXPECT_NEAR(last.maxEnergyJ, ofSpeed, 1e-6 * ofSpeed);
  EXPECT_LT(last.maxRotationJ, 1e-6 * ofSpeed);
}

TEST(Run_AFallOntoTheGround, IsAnImpactWithItsEnergies) {
  json document = throwCase();
  document["rocks"][0]["release"] = {{"box_m", {{20, 0}, {20, 0}}}, {"above_ground_m", 5}};
  document["duration_s"] = 4;
  const Scene scene = test::prepared(document);
  const RunResult result = simulate(scene, 0).value().result;
  ASSERT_GE(result.impacts.size(), 1U);
  const ImpactRecord& impact = result.impacts[0];
  EXPECT_EQ(impact.other, -1);
  EXPECT_EQ(impact.material, 1U);
  EXPECT_LT(impact.energyAfterJ, impact.energyBeforeJ);
  // It falls between 5 m and that and twice its reach.
  const double perMetre = result.rocks[0].massKg * kGravity;
  EXPECT_GT(impact.energyBeforeJ, 4.9 * perMetre);
  EXPECT_LT(impact.energyBeforeJ, 6.5 * perMetre);
  EXPECT_GT(impact.impulseNS, result.rocks[0].massKg * 5) << "it came with 10 m/s";
}

TEST(Run_OffTheEdge, EndsAsLeftAndNothingIsLost) {
  json document = test::plainCase();
  document["effects"] = json::array();
  document["duration_s"] = 12;
  const Scene scene = test::prepared(document);
  const RunResult result = simulate(scene, 1).value().result;
  for (const RockRecord& rock : result.rocks) EXPECT_EQ(rock.ending, RockEnd::left) << "nothing stops it";
  EXPECT_LT(result.steps, 1200U) << "it ends when no rock is left";
}

TEST(Run_IntoTheGround, ARockThatDivesWithItsCentreComesUpAgain) {
  json document = throwCase();
  document["outputs"]["trajectories_every_s"] = 0.01;
  document["rocks"][0]["sieve_m"]["sizes"] = {{0.5, 0}, {0.5, 1}};
  // 0.8 m in the first step, from where a ball around it would be 0.3 m above the ground.
  document["rocks"][0]["release"] = {
      {"box_m", {{30, 0}, {30, 0}}}, {"above_ground_m", 0.3}, {"velocity_m_per_s", {0, 0, -80}}};
  const RunResult result = simulate(test::prepared(document), 0).value().result;
  ASSERT_GE(result.trajectories[0].size(), 2U);
  EXPECT_LT(result.trajectories[0][1].heightM, 0);
  EXPECT_EQ(result.rocks[0].ending, RockEnd::moving);
  EXPECT_GT(result.trajectories[0].back().heightM, 0);
}

TEST(Run_Friction, OfThePairDecidesWhetherAnythingSlides) {
  json document = test::plainCase();
  document["terrain"]["slope_deg"] = 20;
  document["terrain"].erase("zones");
  document["rocks"][0]["make"] = {{"kind", "slabby"}};
  document["rocks"][0]["release"] = {{"box_m", {{5, -3}, {8, 3}}}, {"above_ground_m", 0}};
  document["duration_s"] = 6;
  const auto runout = [&](double friction) {
    document["effects"][0]["pairs"][0]["value"] = friction;
    const RunResult result = simulate(test::prepared(document), 1).value().result;
    return std::max(result.rocks[0].runoutM(), result.rocks[1].runoutM());
  };
  // tan 20 degrees is 0.36.
  EXPECT_GT(runout(0.1), 15);
  EXPECT_LT(runout(1.5), 5);
}

TEST(Run_Effects, AreReportedInTheCasesOrder) {
  json document = test::plainCase();
  document["effects"].push_back({{"effect", "water"}, {"level_m", -1000}});
  document["effects"].push_back({{"effect", "air_drag"}});
  const auto run = simulate(test::prepared(document), 0);
  ASSERT_TRUE(run) << run.error().message;
  const std::vector<EffectReport>& effects = run.value().cost.effects;
  ASSERT_EQ(effects.size(), document["effects"].size());
  EXPECT_EQ(effects[effects.size() - 2].name, "water");
  EXPECT_EQ(effects[effects.size() - 2].acted, 0U) << "far below everything";
  EXPECT_EQ(effects.back().name, "air_drag");
  EXPECT_GT(effects.back().acted, 0U);
}

// A blow that breaks: pieces are rocks of their own whose masses add up, and the whole ends there.
TEST(Run_Fragmentation, PiecesGoOnAsRocks) {
  json document = test::plainCase();
  document["rocks"][0]["count"] = 3;
  document["rocks"][0]["release"]["above_ground_m"] = 15;
  document["effects"].push_back({{"effect", "fragmentation"}, {"energy_j_per_kg", 20}, {"max_generations", 2}});
  const auto run = simulate(test::prepared(document), 0);
  ASSERT_TRUE(run) << run.error().message;
  const std::vector<RockRecord>& rocks = run.value().result.rocks;
  ASSERT_GT(rocks.size(), 4U) << "something broke";
  std::vector<double> pieces(rocks.size());
  for (const RockRecord& rock : rocks)
    if (rock.brokenFrom >= 0) pieces[static_cast<std::size_t>(rock.brokenFrom)] += rock.massKg;
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    EXPECT_EQ(pieces[i] > 0, rocks[i].ending == RockEnd::broken);
    if (pieces[i] > 0) EXPECT_NEAR(pieces[i] / rocks[i].massKg, 1, 1e-5);
    EXPECT_GE(rocks[i].endS, rocks[i].releaseS);
    if (rocks[i].brokenFrom >= 0) EXPECT_EQ(rocks[i].start, rocks[static_cast<std::size_t>(rocks[i].brokenFrom)].start);
  }
}

// Pieces of concave rocks touch along uneven cuts. Besides their own contacts only the ground could give them energy:
// Bullet pushes out what has dived in by a step's way at a fifth of that way a step, so with at most a fifth of the
// speed squared.
TEST(Run_Fragmentation, GivesNoEnergyHoweverShortTheStep) {
  constexpr double kPushedOut = 0.04;
  for (const double step : {1.0 / 120, 1.0 / 1000}) {
    json document = test::plainCase();
    document["step_s"] = step;
    document["duration_s"] = 0.6;
    document["gravity_m_per_s2"] = 0;
    document["terrain"] =
        json::parse(R"({"generated": "plane", "length_m": 40, "width_m": 20, "slope_deg": 0, "material": "soil"})");
    document["rocks"][0]["count"] = 1;
    document["rocks"][0]["release"]["velocity_m_per_s"] = {0, 0, -10};
    document["effects"] = json::parse(R"([{"effect": "fragmentation", "energy_j_per_kg": 5, "max_generations": 1}])");
    document["outputs"]["trajectories_every_s"] = step;
    const Scene scene = test::prepared(document);
    int broken = 0;
    for (std::uint64_t number = 0; number < 12; ++number) {
      const auto run = simulate(scene, number);
      ASSERT_TRUE(run) << run.error().message;
      const RunResult& result = run.value().result;
      // Energy of all rocks there are, by sample.
      std::map<long, double> energy;
      double brokenAt = -1;
      for (std::size_t rock = 0; rock < result.rocks.size(); ++rock) {
        if (result.rocks[rock].ending == RockEnd::broken) brokenAt = result.rocks[rock].endS;
        for (const TrajectorySample& sample : result.trajectories[rock])
          energy[std::lround(sample.timeS / step)] += sample.energyJ;
      }
      if (brokenAt < 0) continue;
      ++broken;
      double least = 0;
      for (const auto& [sample, sum] : energy) {
        if (static_cast<double>(sample) * step < brokenAt + 1.5 * step) least = sum;
        EXPECT_LE(sum, least + kPushedOut * energy.begin()->second) << "step " << step << ", run " << number;
        least = std::min(least, sum);
      }
    }
    EXPECT_GT(broken, 6);
  }
}

}  // namespace
}  // namespace cairn::rockfall::simulation_test
