// SPDX-License-Identifier: GPL-3.0-or-later
// A case made of maps alone, run and merged by the program; GDAL's own programs open what it wrote, and the tables say
// what has to be in it.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <regex>
#include <sstream>

#include "map_files.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall::map_program_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::contentOf;

/// Lines of a CSV by column.
struct Table {
  explicit Table(const fs::path& file) {
    std::istringstream lines(contentOf(file));
    std::string line;
    std::getline(lines, line);
    columns = split(line);
    while (std::getline(lines, line)) rows.push_back(split(line));
  }
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line + ",");
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
  }
  std::string at(std::size_t row, const std::string& column) const {
    const auto found = std::ranges::find(columns, column);
    EXPECT_NE(found, columns.end()) << column;
    return rows.at(row).at(static_cast<std::size_t>(found - columns.begin()));
  }
  double number(std::size_t row, const std::string& column) const { return std::stod(at(row, column)); }

  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// What ogrinfo says of a layer.
struct LayerInfo {
  LayerInfo(const fs::path& file, const std::string& layer)
      : text(test::gdal("ogrinfo -so '" + file.string() + "' " + layer)) {}
  std::string found(const std::string& pattern) const {
    std::smatch match;
    EXPECT_TRUE(std::regex_search(text, match, std::regex(pattern))) << pattern << " in\n" << text;
    return match.size() > 1 ? match[1].str() : "";
  }
  int count() const { return std::stoi(found("Feature Count: (\\d+)")); }
  std::array<double, 4> extent() const {
    std::array<double, 4> sides{};
    std::smatch match;
    EXPECT_TRUE(std::regex_search(text, match, std::regex("Extent: \\((.*), (.*)\\) - \\((.*), (.*)\\)"))) << text;
    for (std::size_t i = 0; i < 4 && match.size() == 5; ++i) sides[i] = std::stod(match[i + 1]);
    return sides;
  }
  void isInSwissCoordinates() const { EXPECT_NE(text.find("ID[\"EPSG\",2056]]"), std::string::npos) << text; }

  std::string text;
};

class MapProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!hasGdal() || !test::hasGdalPrograms()) GTEST_SKIP() << "needs GDAL and Debian's package gdal-bin";
    for (const auto& entry : fs::directory_iterator(CAIRN_ROCKFALL_EXAMPLES))
      if (entry.path().filename().string().starts_with("maps")) fs::copy(entry.path(), folder_.path());
    json document = json::parse(contentOf(path("maps.json")), nullptr, true, true);
    // The terrain in a file that says where it is, and maps of three formats, one in other coordinates.
    test::gdal("gdal_translate -a_srs EPSG:2056 '" CAIRN_ROCKFALL_EXAMPLES "/gully.asc' " + path("slope.tif"));
    document["terrain"].erase("crs");
    document["terrain"]["raster"] = "slope.tif";
    test::gdal("ogr2ogr -f GPKG " + path("protection.gpkg") + " " + path("maps_net.geojson") + " -nln net");
    test::gdal("ogr2ogr -f GPKG -update " + path("protection.gpkg") + " " + path("maps_road.geojson") + " -nln road");
    test::gdal("ogr2ogr -f 'ESRI Shapefile' -t_srs EPSG:4326 " + path("soils.shp") + " " + path("maps_soils.geojson"));
    // A cell of two metres where the sources are: as a mask.
    test::gdal("gdal_rasterize -burn 1 -tr 2 2 -te 2601200 1163420 2601480 1163580 -ot Byte " +
               path("maps_sources.geojson") + " " + path("sources.tif"));
    document["terrain"]["zones"][0]["vector"] = "soils.shp";
    document["rocks"][0]["release"] = {{"raster", "sources.tif"}, {"above_ground_m", 0.3}, {"interval_s", 1}};
    document["rocks"][0]["tree_depth"] = 1;
    for (json& effect : document["effects"])
      if (effect["effect"] == "barrier")
        effect.update({{"vector", "protection.gpkg"}, {"layer", "net"}, {"capacity_j", 1000}});
    document["collectors"][0] = {{"name", "road"}, {"vector", "protection.gpkg"}, {"layer", "road"}};
    std::ofstream(path("slope.json")) << document.dump(1);
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  void runAndMerge() const {
    const std::string cache = " --cache '" + path("trees") + "'";
    const auto told = test::runProgram("rockfall", "explain '" + path("slope.json") + "'" + cache);
    ASSERT_EQ(told.exitCode, 0) << told.errors;
    EXPECT_NE(told.output.find("map /terrain/zones/0: soils.shp: 3 features, reprojected from EPSG:4326"),
              std::string::npos)
        << told.output;
    const auto run =
        test::runProgram("rockfall", "run '" + path("slope.json") + "' --runs 0:4 -o '" + path("runs") + "'" + cache);
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    const auto merged = test::runProgram(
        "rockfall", "merge '" + path("runs") + "' -o '" + path("results") + "' --geopackage --geojson");
    ASSERT_EQ(merged.exitCode, 0) << merged.errors;
    EXPECT_NE(merged.output.find("95 % of run-out up to "), std::string::npos) << merged.output;
  }

  test::TemporaryFolder folder_;
};

void compareStops(const LayerInfo& stops, const Table& rocks) {
  EXPECT_EQ(stops.count(), static_cast<int>(rocks.rows.size()));
  stops.isInSwissCoordinates();
  stops.found("Geometry: 3D Point");
  for (const char* field : {"run: Integer", "rock: Integer", "ending: String", "runout_m: Real", "fall_m: Real",
                            "energy_line_deg: Real", "energy_max_kJ: Real", "speed_max_m_per_s: Real"})
    stops.found(std::string("\n") + field);
  std::array<double, 4> expected{1e300, 1e300, -1e300, -1e300};
  for (std::size_t i = 0; i < rocks.rows.size(); ++i) {
    const double x = rocks.number(i, "end_x_m"), y = rocks.number(i, "end_y_m");
    expected = {std::min(expected[0], x), std::min(expected[1], y), std::max(expected[2], x), std::max(expected[3], y)};
  }
  constexpr double kDigits = 1e-3;  // of the table and of what ogrinfo prints
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(stops.extent()[i], expected[i], kDigits);
}

TEST_F(MapProgram, WritesWhatGdalsProgramsReadBack) {
  runAndMerge();
  if (HasFatalFailure()) return;
  const fs::path results = folder_.path() / "results";
  const Table rocks(results / "rocks.csv"), summary(results / "collectors_summary.csv");
  compareStops(LayerInfo(results / "results.gpkg", "stops"), rocks);
  compareStops(LayerInfo(results / "stops.geojson", "stops"), rocks);
  const LayerInfo ways(results / "results.gpkg", "trajectories");
  EXPECT_EQ(ways.count(), static_cast<int>(rocks.rows.size()));
  ways.isInSwissCoordinates();
  ways.found("Geometry: 3D Multi Line String");
  const LayerInfo collectors(results / "results.gpkg", "collectors");
  EXPECT_EQ(collectors.count(), 1);
  collectors.isInSwissCoordinates();
  for (const char* field :
       {"probability: Real", "energy_p95_kJ: Real", "height_p99_m: Real", "speed_max_m_per_s: Real"})
    collectors.found(std::string("\n") + field);
  EXPECT_EQ(collectors.extent(), (std::array<double, 4>{2601405, 1163422, 2601435, 1163576})) << "the road's";
  const std::string row =
      test::gdal("ogr2ogr -f CSV /vsistdout/ '" + (results / "results.gpkg").string() + "' collectors");
  EXPECT_GT(summary.number(0, "arrived"), 0) << "for the comparison to mean something";
  const std::string quoted = "road,\"" + summary.at(0, "released") + "\",\"" + summary.at(0, "arrived") + "\",";
  EXPECT_NE(row.find(quoted), std::string::npos) << row;
  const double p95 = std::stod(Table::split(row.substr(row.find("road,"))).at(6));
  EXPECT_NEAR(p95, summary.number(0, "energy_p95_j") / 1000, 1e-5 * p95) << "kJ of J, six digits";
}

TEST_F(MapProgram, WritesRastersThatSayWhatAndWhereTheyAre) {
  runAndMerge();
  if (HasFatalFailure()) return;
  const fs::path results = folder_.path() / "results";
  const auto infoOf = [&](const std::string& file) {
    return json::parse(test::gdal("gdalinfo -json -stats '" + (results / file).string() + "' 2> /dev/null"));
  };
  const json energy = infoOf("energy_p95_j.tif");
  EXPECT_EQ(energy.at("bands").at(0).at("unit"), "J");
  EXPECT_EQ(energy.at("bands").at(0).at("description"), "95 % quantile of the rocks' greatest kinetic energies");
  for (const char* file : {"energy_p95_j.tif", "reach_probability.tif", "height_max_m.asc", "reach.asc"}) {
    const json info = infoOf(file);
    EXPECT_NE(info.at("coordinateSystem").at("wkt").get<std::string>().find("CH1903+"), std::string::npos) << file;
    EXPECT_EQ(info.at("geoTransform").at(1), 2) << file;
    // The cells that cover the ground, from the map's origin on: the raster's points span it, its cells go beyond.
    EXPECT_EQ(info.at("cornerCoordinates").at("lowerLeft"), (json{2601200, 1163420})) << file;
    EXPECT_EQ(info.at("cornerCoordinates").at("upperRight"), (json{2601480, 1163580})) << file;
  }
  const json probability = infoOf("reach_probability.tif");
  EXPECT_LE(probability.at("bands").at(0).at("maximum").get<double>(), 1);
  EXPECT_GT(probability.at("bands").at(0).at("maximum").get<double>(), 0);
}

TEST_F(MapProgram, GivesTheAngleOfTheEnergyLine) {
  runAndMerge();
  if (HasFatalFailure()) return;
  const Table rocks(folder_.path() / "results" / "rocks.csv");
  ASSERT_EQ(rocks.rows.size(), 20U);
  for (std::size_t i = 0; i < rocks.rows.size(); ++i) {
    const double fall = rocks.number(i, "start_z_m") - rocks.number(i, "end_z_m");
    const double angle = rocks.number(i, "energy_line_deg");
    EXPECT_NEAR(std::tan(angle * std::numbers::pi / 180) * rocks.number(i, "runout_m"), fall,
                0.02 + 1e-3 * std::abs(fall));
  }
}

TEST_F(MapProgram, MergesTheSameForAnyNumberOfWorkers) {
  runAndMerge();
  if (HasFatalFailure()) return;
  const auto hashOf = [&](const std::string& folder) {
    return json::parse(contentOf(folder_.path() / folder / "manifest.json")).at("merged_hash").get<std::string>();
  };
  const auto run = test::runProgram("rockfall", "run '" + path("slope.json") + "' --runs 0:4 --jobs 2 -o '" +
                                                    path("again") + "' --cache '" + path("trees") + "'");
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  ASSERT_EQ(test::runProgram("rockfall", "merge '" + path("again") + "' -o '" + path("merged") + "'").exitCode, 0);
  EXPECT_EQ(hashOf("merged"), hashOf("results")) << "what GDAL writes is not in it";
  // The maps belong to the case.
  std::ofstream(path("soils.cpg"), std::ios::app) << "\n";
  const auto changed = test::runProgram("rockfall", "merge '" + path("again") + "' -o '" + path("merged") + "'");
  EXPECT_EQ(changed.exitCode, 1);
  EXPECT_NE(changed.errors.find("the files the case names have changed since it was run"), std::string::npos)
      << changed.errors;
}

}  // namespace
}  // namespace cairn::rockfall::map_program_test
