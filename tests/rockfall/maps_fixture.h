// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "map_files.h"
#include "rockfall/gis/map_layer.h"
#include "rockfall/gis/read_maps.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall::maps_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::FeatureToWrite;
using test::lineOf;
using test::pointAt;
using test::rectangle;

inline constexpr double kX = 2601220, kY = 1163420;  // inside the gully's raster
/// m. Two datums are brought together to a metre or so; the ways there and back may be two published ones.
inline constexpr double kThereAndBack = 0.01;

/// A case whose places come from maps that a test writes into a folder of its own.
class Maps : public ::testing::Test {
 protected:
  Maps() {
    fs::copy(fs::path(CAIRN_ROCKFALL_EXAMPLES) / "gully.asc", path("gully.asc"));
    case_ = json::parse(R"({
      "case": "maps", "seed": 1, "step_s": 0.01, "duration_s": 4, "materials": ["stone", "scree", "meadow"],
      "terrain": {"raster": "gully.asc", "crs": "EPSG:2056", "material": "scree", "zones": []},
      "rocks": [{"count": 2, "make": {"kind": "angular"}, "sieve_m": {"sizes": [[0.4, 0], [0.8, 1]]},
                 "density_kg_per_m3": 2600, "material": "stone",
                 "release": {"box_m": [[2601232, 1163480], [2601242, 1163520]], "above_ground_m": 1}}],
      "effects": [], "collectors": []})");
  }
  void SetUp() override {
    if (!hasGdal()) GTEST_SKIP() << "built without GDAL";
  }

  fs::path path(const std::string& name) const { return temporary_.path() / name; }
  void release(const json& map) {
    case_["rocks"][0]["release"] = map;
    case_["rocks"][0]["release"]["above_ground_m"] = 1;
  }

  /// The case with its maps read.
  Result<Case> read() const {
    auto parsed = parseCase(case_.dump(), "case.json", temporary_.path());
    if (!parsed) return parsed;
    auto terrain = terrainOf(parsed.value());
    if (!terrain) return terrain.error();
    if (const Status maps = readMaps(parsed.value(), terrain.value()); !maps) return maps.error();
    return parsed;
  }
  Case good() const {
    auto all = read();
    EXPECT_TRUE(all) << all.error().message;
    return all ? std::move(all).value() : Case();
  }
  /// The sentence with which the case is refused, without the temporary folder.
  std::string refusal() const {
    const auto all = read();
    if (all) return "read, though it had to be refused";
    std::string message = all.error().message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    const std::string folder = temporary_.path().string() + "/";
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
      message.erase(at, folder.size());
    return message;
  }

  test::TemporaryFolder temporary_;
  json case_;
};

inline const auto kCliff = rectangle(kX + 12, kY + 60, kX + 22, kY + 100,
                                     {{kX + 14, kY + 70}, {kX + 18, kY + 70}, {kX + 18, kY + 90}, {kX + 14, kY + 70}});

}  // namespace cairn::rockfall::maps_test
