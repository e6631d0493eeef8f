// SPDX-License-Identifier: GPL-3.0-or-later
// Ground from rasters and meshes: as the files say, far from the map's origin as near it, whatever their format.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "prepared_scene.h"
#include "rockfall/simulation/run.h"
#include "rockfall/simulation/world_origin.h"
#include "rockfall/terrain/ascii_grid.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall::ground_test {
namespace {

using nlohmann::json;

// A hillside of 80 m by 60 m; x and y from its lower corner.
double heightOf(double x, double y) {
  return 30 - 0.5 * x + 0.02 * (y - 30) * (y - 30) + std::sin(0.7 * x) * std::cos(0.4 * y);
}

/// Its lower corner is at (x, y) of the map. Heights are floats, as GeoTIFFs mostly hold them.
Raster hillside(double x, double y) {
  Raster raster{41, 31, 2, x, y, {}, {}};
  for (std::uint32_t row = 0; row < raster.rows; ++row)
    for (std::uint32_t column = 0; column < raster.columns; ++column)
      raster.values.push_back(double(static_cast<float>(heightOf(2.0 * column, 2.0 * row))));
  return raster;
}

/// Cases on files of one folder.
class RasterCase : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

  /// Two rocks on the hillside with its corner at (x, y).
  static json document(const std::string& raster, double x, double y) {
    json made = test::plainCase();
    made["terrain"] = {{"raster", raster},
                       {"material", "soil"},
                       {"zones",
                        {{{"material", "stone"},
                          {"polygon_m", {{x + 20, y + 10}, {x + 60, y + 10}, {x + 60, y + 50}, {x + 20, y + 50}}}}}}};
    made["rocks"][0]["release"]["box_m"] = {{x + 4, y + 20}, {x + 8, y + 40}};
    made["collectors"][0]["line_m"] = {{x + 15, y}, {x + 15, y + 60}};
    return made;
  }
  Result<Scene> prepare(const json& document) const {
    auto description = parseCase(document.dump(), "case.json", folder_.path());
    if (!description) return description.error();
    TreeCache cache(test::treeFolder());
    return prepareScene(std::move(description).value(), cache);
  }
  std::string refusalOf(const json& document) const {
    const auto scene = prepare(document);
    return scene ? std::string("accepted") : scene.error().message;
  }

  test::TemporaryFolder folder_;
};

TEST_F(RasterCase, GeoTiffAndEsriAsciiGiveTheSameRun) {
  if (!hasGdal()) GTEST_SKIP() << "built without GDAL";
  ASSERT_TRUE(writeGeoTiff(file("hill.tif"), hillside(500, 700)));
  ASSERT_TRUE(writeAsciiGrid(file("hill.asc"), hillside(500, 700)));
  const auto tiff = prepare(document("hill.tif", 500, 700)), ascii = prepare(document("hill.asc", 500, 700));
  ASSERT_TRUE(tiff) << tiff.error().message;
  ASSERT_TRUE(ascii) << ascii.error().message;
  const RunResult first = simulate(tiff.value(), 2).value().result, second = simulate(ascii.value(), 2).value().result;
  EXPECT_EQ(first.stateHash, second.stateHash);
  EXPECT_GT(first.rocks[0].runoutM(), 5) << "they roll";
  EXPECT_FALSE(first.impacts.empty());
  EXPECT_FALSE(first.crossings.empty());
}

TEST_F(RasterCase, HasTheHeightsAndMaterialsOfItsFiles) {
  ASSERT_TRUE(writeAsciiGrid(file("hill.asc"), hillside(500, 700)));
  const auto description = parseCase(document("hill.asc", 500, 700).dump(), "case.json", folder_.path());
  const auto ground = makeGround(description.value()).value();
  for (int column = 0; column < 40; ++column)
    for (int row = 0; row < 30; ++row) {
      const MapPoint point{500 + 2.0 * column, 700 + 2.0 * row};
      ASSERT_TRUE(ground->covers(point));
      // Below 64 m floats are rounded by 2^-19 m: as a raster's value and over the grid's own height.
      ASSERT_NEAR(ground->heightAt(point), heightOf(2.0 * column, 2.0 * row), 4e-6);
      ASSERT_EQ(ground->materialAt(point), column >= 10 && column < 30 && row >= 5 && row < 25 ? 0U : 1U);
    }
  EXPECT_FALSE(ground->covers({499.9, 720}));
  EXPECT_FALSE(ground->covers({580, 720}));
}

// 2600 km from the map's origin a float's steps are a quarter of a metre. The world's origin is moved by whole
// kilometres, so that the same hillside near the map's origin is the same world to the bit.
TEST_F(RasterCase, FarFromTheMapsOriginIsTheSameRunInTheMapsCoordinates) {
  ASSERT_TRUE(writeAsciiGrid(file("near.asc"), hillside(300, -200)));
  ASSERT_TRUE(writeAsciiGrid(file("far.asc"), hillside(2600300, 1199800)));
  const auto near = prepare(document("near.asc", 300, -200)), far = prepare(document("far.asc", 2600300, 1199800));
  ASSERT_TRUE(near) << near.error().message;
  ASSERT_TRUE(far) << far.error().message;
  EXPECT_EQ(near.value().worldOrigin, (MapPoint{0, 0}));
  EXPECT_EQ(far.value().worldOrigin, (MapPoint{2600000, 1200000}));
  const RunResult here = simulate(near.value(), 2).value().result, there = simulate(far.value(), 2).value().result;
  EXPECT_EQ(here.stateHash, there.stateHash);
  const auto expectMoved = [](const Vec3d& from, const Vec3d& to) { EXPECT_EQ(to, from + Vec3d(2600000, 1200000, 0)); };
  for (std::size_t rock = 0; rock < here.rocks.size(); ++rock) {
    expectMoved(here.rocks[rock].start, there.rocks[rock].start);
    expectMoved(here.rocks[rock].end, there.rocks[rock].end);
    expectMoved(here.trajectories[rock].back().place, there.trajectories[rock].back().place);
  }
  ASSERT_EQ(here.impacts.size(), there.impacts.size());
  for (std::size_t i = 0; i < here.impacts.size(); ++i) {
    expectMoved(here.impacts[i].place, there.impacts[i].place);
    EXPECT_EQ(here.impacts[i].material, there.impacts[i].material);
  }
  ASSERT_FALSE(here.crossings.empty());
  ASSERT_EQ(here.crossings.size(), there.crossings.size());
  EXPECT_EQ(here.crossings[0].alongM, there.crossings[0].alongM);
  ASSERT_EQ(here.cells.size(), there.cells.size());
  EXPECT_EQ(here.cells[0].column + 2600000, there.cells[0].column);
  EXPECT_EQ(here.cells[0].row + 1200000, there.cells[0].row);
}

TEST_F(RasterCase, WhatHasAPlaceInAnEffectIsMovedToo) {
  json made = document("hill.asc", 2600300, 1199800);
  const json region = {{2600300, 1199800}, {2600400, 1199800}, {2600300, 1199900}};
  made["effects"] = {{{"effect", "water"}, {"level_m", 1}, {"polygon_m", region}},
                     {{"effect", "trees"}, {"stems", {{2600310, 1199810, 0.3}}}}};
  ASSERT_TRUE(writeAsciiGrid(file("hill.asc"), hillside(2600300, 1199800)));
  const auto scene = prepare(made);
  ASSERT_TRUE(scene) << scene.error().message;
  const auto& effects = scene.value().description.effects;
  EXPECT_EQ(findEffect<WaterOptions>(effects)->polygon, (Polygon{{300, -200}, {400, -200}, {300, -100}}));
  EXPECT_EQ(std::get<std::vector<Stem>>(findEffect<TreesOptions>(effects)->stems)[0].placeM, (MapPoint{310, -190}));
}

TEST_F(RasterCase, HolesAreNotCoveredAndRocksLeaveThroughThem) {
  Raster raster = hillside(0, 0);
  for (std::uint32_t row = 0; row < raster.rows; ++row)
    for (std::uint32_t column = 10; column < 20; ++column)
      raster.at(column, row) = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(writeAsciiGrid(file("hole.asc"), raster));
  json made = document("hole.asc", 0, 0);
  made["effects"] = json::array();
  made["duration_s"] = 20;
  const auto scene = prepare(made);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene.value().ground->covers({17.9, 31}));
  EXPECT_FALSE(scene.value().ground->covers({18.1, 31})) << "a triangle with a corner that has no height is missing";
  EXPECT_TRUE(scene.value().ground->covers({40.1, 31}));
  const RunResult result = simulate(scene.value(), 0).value().result;
  for (const RockRecord& rock : result.rocks) {
    EXPECT_EQ(rock.ending, RockEnd::hole);
    EXPECT_LE(rock.end.x, 18);
  }
  json inHole = made;
  inHole["rocks"][0]["release"]["box_m"] = {{25, 20}, {45, 40}};
  EXPECT_EQ(refusalOf(inHole),
            "/rocks/0/release/box_m: the corner (25, 20) is not over the ground, which covers x from 0 to 80 and y "
            "from 0 to 60 but for holes");
  // Without a hole the rocks go on to the edge.
  ASSERT_TRUE(writeAsciiGrid(file("hole.asc"), hillside(0, 0)));
  const auto whole = prepare(made);
  const RunResult onWhole = simulate(whole.value(), 0).value().result;
  for (const RockRecord& rock : onWhole.rocks) EXPECT_EQ(rock.ending, RockEnd::left);
}

TEST_F(RasterCase, MeshesAreSampledFromAbove) {
  std::ofstream(file("roof.obj")) << "v 0 0 8\nv 60 0 2\nv 60 40 2\nv 0 40 8\nf 1 2 3\nf 1 3 4\n";
  json made = document("none.asc", 0, 0);
  made["terrain"].erase("raster");
  made["terrain"]["mesh"] = "roof.obj";
  made["terrain"]["cell_m"] = 4;
  made["rocks"][0]["release"]["box_m"] = {{4, 10}, {8, 30}};
  const auto scene = prepare(made);
  ASSERT_TRUE(scene) << scene.error().message;
  // 2^-22 m is half a float's step below 8 m.
  EXPECT_NEAR(scene.value().ground->heightAt({31, 17}), 8 - 3.1, 1e-6);
  EXPECT_TRUE(simulate(scene.value(), 0));
}

TEST_F(RasterCase, TheSceneHashSeesTheTerrain) {
  ASSERT_TRUE(writeAsciiGrid(file("hill.asc"), hillside(0, 0)));
  const Scene before = std::move(prepare(document("hill.asc", 0, 0))).value();
  Raster other = hillside(0, 0);
  other.at(3, 4) += 0.5;
  ASSERT_TRUE(writeAsciiGrid(file("hill.asc"), other));
  const Scene after = std::move(prepare(document("hill.asc", 0, 0))).value();
  EXPECT_NE(before.description.hash, after.description.hash);
  EXPECT_NE(before.hash, after.hash);
}

TEST_F(RasterCase, IsRefusedInOneSentence) {
  std::ofstream(file("cut.asc")) << "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1.5 2 3\n4 5\n";
  EXPECT_EQ(refusalOf(document("cut.asc", 0, 0)),
            "/terrain/raster: " + file("cut.asc").string() + ", line 8: the file ends after 5 of 6 values");
  ASSERT_TRUE(writeAsciiGrid(file("row.asc"), {3, 1, 1, 0, 0, {1, 2, 3}, {}}));
  EXPECT_EQ(refusalOf(document("row.asc", 0, 0)),
            "/terrain/raster: " + file("row.asc").string() + " has 3 x 1 values: a terrain needs at least two a side");
  const double none = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(writeAsciiGrid(file("empty.asc"), {2, 2, 1, 0, 0, {none, none, none, none}, {}}));
  EXPECT_EQ(refusalOf(document("empty.asc", 0, 0)),
            "/terrain/raster: " + file("empty.asc").string() + " has no heights: a terrain needs some");
  std::ofstream(file("text.tif")) << "no raster\n";
  const std::string text = refusalOf(document("text.tif", 0, 0));
  EXPECT_TRUE(text.starts_with("/terrain/raster: " + file("text.tif").string())) << text;
  EXPECT_NE(text.find(hasGdal() ? "GDAL cannot read it" : "built without GDAL"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST_F(RasterCase, LargerThanSinglePrecisionServesIsRefused) {
  Raster wide{3, 3, 20000, 0, 0, std::vector<double>(9, 5), {}};
  ASSERT_TRUE(writeAsciiGrid(file("wide.asc"), wide));
  EXPECT_EQ(refusalOf(document("wide.asc", 0, 0)),
            "/terrain: the ground reaches 20.0 km from its middle, its heights 0.0 km, and single precision tells half "
            "a millimetre up to 16.4 km: cut out a smaller part of the map");
}

TEST_F(RasterCase, GeoTiffIsWrittenWhereAskedForOrRefusedByName) {
  ASSERT_TRUE(writeAsciiGrid(file("hill.asc"), hillside(2600300, 1199800)));
  json made = document("hill.asc", 2600300, 1199800);
  made["outputs"]["geotiff"] = true;
  if (!hasGdal()) {
    EXPECT_TRUE(refusalOf(made).starts_with("/outputs/geotiff: this program was built without GDAL"));
    return;
  }
  std::ofstream(file("case.json")) << made.dump();
  const auto program = [&](const std::string& arguments) {
    const test::ProgramResult result = test::runProgram("rockfall", arguments);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
  };
  const std::string folder = folder_.path().string(), cache = " --cache '" + test::treeFolder().string() + "'";
  program("explain '" + folder + "/case.json'" + cache);
  program("run '" + folder + "/case.json' --runs 0:2 -o '" + folder + "/runs'" + cache);
  program("merge '" + folder + "/runs' -o '" + folder + "/merged'");
  for (const char* name : {"reach", "stops", "energy_max_j", "rotation_p50_j", "speed_mean_m_per_s", "height_p95_m"}) {
    const auto ascii = readRaster(file("merged") / (std::string(name) + ".asc"));
    const auto tiff = readRaster(file("merged") / (std::string(name) + ".tif"));
    ASSERT_TRUE(ascii) << ascii.error().message;
    ASSERT_TRUE(tiff) << tiff.error().message;
    EXPECT_EQ(ascii.value().x, 2600300.5) << "cells of a metre, in the map's coordinates";
    EXPECT_EQ(tiff.value().x, ascii.value().x);
    EXPECT_EQ(tiff.value().y, ascii.value().y);
    ASSERT_EQ(tiff.value().values.size(), ascii.value().values.size());
    std::size_t visited = 0;
    for (std::size_t i = 0; i < ascii.value().values.size(); ++i) {
      const double a = ascii.value().values[i], b = tiff.value().values[i];
      visited += !std::isnan(a);
      ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << name;
    }
    EXPECT_GT(visited, 5U) << name;
  }
}

}  // namespace
}  // namespace cairn::rockfall::ground_test
