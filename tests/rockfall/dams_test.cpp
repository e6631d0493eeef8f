// SPDX-License-Identifier: GPL-3.0-or-later
// Dams on terrains: their heights by formula, their rocks, their refusals.
#include "rockfall/terrain/dams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "prepared_scene.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall::dams_test {
namespace {

using nlohmann::json;

constexpr double kDegree = std::numbers::pi / 180;

json damCase(const json& dams, double slopeDeg = 0) {
  json document = test::plainCase();
  document["terrain"] = {{"generated", "plane"}, {"length_m", 60}, {"width_m", 40}, {"slope_deg", slopeDeg},
                         {"material", "soil"},   {"cell_m", 0.5},  {"dams", dams}};
  return document;
}

Result<MapTerrain> raised(const json& dams, double slopeDeg = 0) {
  auto read = test::readJson(damCase(dams, slopeDeg));
  if (!read) return read.error();
  auto terrain = terrainOf(read.value());
  if (!terrain) return terrain;
  if (const Status done = raiseDams(read.value(), terrain.value()); !done) return done.error();
  return terrain;
}

TEST(ADam, HasItsCrestItsSidesAndItsFoot) {
  const auto terrain =
      raised(json::parse(R"([{"line_m": [[30, -10], [30, 10]], "height_m": 4, "crest_m": 2, "slope_deg": [60, 30]}])"));
  ASSERT_TRUE(terrain) << terrain.error().message;
  const auto& grid = terrain.value().grid;
  const float ground = grid.heights.front();  // level
  std::size_t looked = 0;
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const double x = grid.origin.x + column * grid.cell, y = grid.origin.y + row * grid.cell;
      if (std::abs(y) > 10) continue;
      // The line runs north: its left is the west.
      const double slope = std::tan((x <= 30 ? 60 : 30) * kDegree);
      const double expected = std::max(0.0, 4 - slope * std::max(0.0, std::abs(x - 30) - 1));
      EXPECT_NEAR(grid.heights[row * grid.columns + column] - ground, expected, 1e-5) << x << ", " << y;
      looked += expected > 0;
    }
  EXPECT_GT(looked, 100U);
  // Its ends are rounded, and beyond them nothing is raised.
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const double x = grid.origin.x + column * grid.cell, y = grid.origin.y + row * grid.cell;
      if (std::hypot(x - 30, std::abs(y) - 10) > 1 + 4 / std::tan(30 * kDegree) && std::abs(y) > 10)
        EXPECT_EQ(grid.heights[row * grid.columns + column], ground);
    }
}

TEST(ADam, FollowsTheGround) {
  const auto plain = raised(json::array(), 20);
  const auto terrain = raised(
      json::parse(R"([{"line_m": [[10, 0], [50, 0]], "height_m": 3, "crest_m": 1, "slope_deg": [45, 45]}])"), 20);
  ASSERT_TRUE(terrain) << terrain.error().message;
  const auto& grid = terrain.value().grid;
  std::size_t looked = 0;
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const double x = grid.origin.x + column * grid.cell, y = grid.origin.y + row * grid.cell;
      const std::size_t i = std::size_t(row) * grid.columns + column;
      if (y != 0 || x < 10 || x > 50) continue;
      ++looked;
      EXPECT_NEAR(grid.heights[i] - plain.value().grid.heights[i], 3, 1e-4) << x;
    }
  EXPECT_EQ(looked, 81U) << "the crest, half a metre a point";
}

TEST(ADam, HoldsRocks) {
  const auto arrived = [](double heightM) {
    json document = damCase(json::array(), 32);
    if (heightM > 0)
      document["terrain"]["dams"] = json::array(
          {{{"line_m", {{40, -20}, {40, 20}}}, {"height_m", heightM}, {"crest_m", 1}, {"slope_deg", {80, 40}}}});
    document["rocks"][0]["count"] = 20;
    document["rocks"][0]["make"] = {{"kind", "rounded"}};
    document["rocks"][0]["meets_rocks"] = false;
    document["collectors"] = json::array({{{"name", "behind"}, {"line_m", {{50, -20}, {50, 20}}}}});
    document["effects"] = json::parse(
        R"([{"effect": "friction", "default": 0.5}, {"effect": "restitution", "law": "constant", "default": 0.2}])");
    document["duration_s"] = 12;
    document["step_s"] = 0.005;
    const RunResult result = simulate(test::prepared(document), 0).value().result;
    std::set<std::uint32_t> rocks;
    for (const CrossingRecord& crossing : result.crossings) rocks.insert(crossing.rock);
    EXPECT_EQ(std::ranges::count(result.rocks, RockEnd::lost, &RockRecord::ending), 0);
    return rocks.size();
  };
  EXPECT_GE(arrived(0), 18U) << "nothing is in the way";
  EXPECT_LE(arrived(5), 2U) << "a wall five metres high";
}

TEST(ADam, IsRefusedWhereItCannotStand) {
  const auto refusal = [](const char* dam) {
    const auto terrain = raised(json::array({json::parse(dam)}));
    return terrain ? std::string() : terrain.error().message;
  };
  EXPECT_TRUE(refusal(R"({"line_m": [[30.2, -10], [30.3, 10]], "height_m": 4, "slope_deg": [89, 89]})")
                  .starts_with("/terrain/dams/0: it raises 0 points of the ground, by 0 m at most: points are 0.5 m"))
      << refusal(R"({"line_m": [[30.2, -10], [30.3, 10]], "height_m": 4, "slope_deg": [89, 89]})");
  EXPECT_TRUE(refusal(R"({"line_m": [[300, -10], [300, 10]], "height_m": 4, "slope_deg": [60, 60]})")
                  .starts_with("/terrain/dams/0: it raises 0 points"));
  EXPECT_TRUE(refusal(R"({"line_m": [[30, -10], [30, 10]], "height_m": 0, "slope_deg": [60, 60]})")
                  .starts_with("case.json: /terrain/dams/0/height_m: "));
  EXPECT_TRUE(refusal(R"({"line_m": [[30, -10], [30, 10]], "height_m": 4, "slope_deg": [60, 95]})")
                  .starts_with("case.json: /terrain/dams/0/slope_deg/1: "));
  EXPECT_TRUE(refusal(R"({"height_m": 4, "slope_deg": [60, 60]})")
                  .starts_with("case.json: /terrain/dams/0: exactly one of \"line_m\" and \"vector\""));
}

}  // namespace
}  // namespace cairn::rockfall::dams_test
