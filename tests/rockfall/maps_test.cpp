// SPDX-License-Identifier: GPL-3.0-or-later
// Maps in cases: places that are read of GeoJSON, GeoPackage, shapefile and rasters. GDAL's own programs
// write the files that are not GeoJSON.
#include "maps_fixture.h"

namespace cairn::rockfall::maps_test {
namespace {

TEST_F(Maps, ReleaseFromPolygonsOfEachFormat) {
  if (!test::hasGdalPrograms()) GTEST_SKIP() << "needs Debian's package gdal-bin";
  test::writeMap(path("cliff.geojson"), {{kCliff, {{"kind", "cliff"}}}});
  test::gdal("ogr2ogr -f GPKG " + path("cliff.gpkg").string() + " " + path("cliff.geojson").string());
  test::gdal("ogr2ogr -f 'ESRI Shapefile' " + path("cliff.shp").string() + " " + path("cliff.geojson").string());
  test::gdal("ogr2ogr -f FlatGeobuf " + path("cliff.fgb").string() + " " + path("cliff.geojson").string());
  for (const char* file : {"cliff.geojson", "cliff.gpkg", "cliff.shp", "cliff.fgb"}) {
    release({{"vector", file}});
    const Case read = good();
    const PlaceSet& places = read.rocks[0].release.places;
    ASSERT_FALSE(places.empty()) << file;
    for (double which = 0.05; which < 1; which += 0.1)
      for (double along = 0.05; along < 1; along += 0.1) {
        const MapPoint place = places.at(which, along, 0.4);
        EXPECT_TRUE(place[0] > kX + 12 && place[0] < kX + 22 && place[1] > kY + 60 && place[1] < kY + 100) << file;
        const bool isInHole = place[1] > kY + 70 && place[1] < kY + 90 && place[0] < kX + 18 &&
                              place[0] > kX + 14 + (place[1] - kY - 70) / 5;
        EXPECT_FALSE(isInHole) << file;
      }
    ASSERT_EQ(read.notes.size(), 1U);
    EXPECT_EQ(read.notes[0].text, std::string(file) + ": 1 features");
    EXPECT_TRUE(mapsOf(read).empty());
  }
}

TEST_F(Maps, ReleaseFromPointsAndLinesWithHeights) {
  test::writeMap(path("points.geojson"),
                 {{{{"type", "Point"}, {"coordinates", {kX + 15, kY + 70, 1234.5}}}},
                  {{{"type", "MultiPoint"}, {"coordinates", {{kX + 16, kY + 71, 0}, {kX + 17, kY + 72, 5}}}}}});
  release({{"vector", "points.geojson"}});
  EXPECT_EQ(good().rocks[0].release.places.pieces().size(), 3U);
  EXPECT_EQ(good().rocks[0].release.places.at(0.4, 0.3, 0.2), (MapPoint{kX + 16, kY + 71}));
  test::writeMap(path("lines.geojson"), {{lineOf({{kX + 15, kY + 70, 9}, {kX + 15, kY + 80, 9}})}});
  release({{"vector", "lines.geojson"}});
  EXPECT_EQ(good().rocks[0].release.places.at(0.5, 0.25, 0.9), (MapPoint{kX + 15, kY + 72.5}));
}

TEST_F(Maps, ReleaseFromARasterMask) {
  Raster mask{40, 30, 1, kX + 10.5, kY + 60.5, std::vector<double>(40 * 30, 0), {}};
  for (std::uint32_t column = 5; column < 9; ++column) mask.at(column, 7) = 1;
  mask.at(20, 20) = 3;
  mask.at(21, 20) = std::nan("");
  ASSERT_TRUE(writeGeoTiff(path("mask.tif"), mask));
  release({{"raster", "mask.tif"}});
  const Case read = good();
  const PlaceSet& places = read.rocks[0].release.places;
  ASSERT_EQ(places.pieces().size(), 2U);
  EXPECT_EQ(places.at(0, 0, 0), (MapPoint{kX + 15, kY + 67}));
  EXPECT_EQ(places.at(0.5, 0.5, 0.5), (MapPoint{kX + 17, kY + 67.5})) << "four cells of five are in the row";
  EXPECT_EQ(places.at(1, 1, 1), (MapPoint{kX + 31, kY + 81}));
}

TEST_F(Maps, ReprojectedFromDegreesAndFromTheNeighbours) {
  if (!test::hasGdalPrograms()) GTEST_SKIP() << "needs Debian's package gdal-bin";
  const std::vector<std::vector<double>> line{{kX + 30, kY + 20}, {kX + 40, kY + 140}, {kX + 45, kY + 145}};
  test::writeMap(path("road.geojson"), {{lineOf(line)}});
  for (const char* crs : {"EPSG:4326", "EPSG:21781", "EPSG:25832"}) {
    fs::remove(path("other.gpkg"));
    test::gdal("ogr2ogr -f GPKG -t_srs " + std::string(crs) + " " + path("other.gpkg").string() + " " +
               path("road.geojson").string());
    case_["collectors"] = {{{"name", "road"}, {"vector", "other.gpkg"}}};
    const Case read = good();
    ASSERT_EQ(read.collectors[0].lines.size(), 1U) << crs;
    ASSERT_EQ(read.collectors[0].lines[0].size(), line.size());
    for (std::size_t i = 0; i < line.size(); ++i)
      for (std::size_t axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(read.collectors[0].lines[0][i][axis], line[i][axis], kThereAndBack) << crs;
    EXPECT_EQ(read.notes.at(0).text, "other.gpkg: 1 features, reprojected from " + std::string(crs));
  }
}

TEST_F(Maps, ZonesByClassesKeepTheOrderOfTheList) {
  test::writeMap(
      path("soils.geojson"),
      {{rectangle(kX, kY, kX + 100, kY + 100,
                  {{kX + 10, kY + 10}, {kX + 20, kY + 10}, {kX + 20, kY + 20}, {kX + 10, kY + 20}, {kX + 10, kY + 10}}),
        {{"class", 1}}},
       {rectangle(kX + 50, kY, kX + 60, kY + 100), {{"class", 2}}},
       {rectangle(kX + 70, kY, kX + 80, kY + 100), {{"class", 3}}},
       {rectangle(0, 0, 9, 9), {{"class", 77}}}});
  const json square{{kX + 30, kY + 30}, {kX + 55, kY + 30}, {kX + 55, kY + 40}, {kX + 30, kY + 40}};
  case_["terrain"]["zones"] = {
      {{"material", "stone"}, {"polygon_m", square}},
      {{"vector", "soils.geojson"},
       {"field", "class"},
       {"materials", {{"1", "meadow"}, {"2", "stone"}, {"3", nullptr}}}},
      {{"material", "scree"}, {"polygon_m", {{kX + 52, kY + 60}, {kX + 58, kY + 60}, {kX + 58, kY + 70}}}}};
  const Case read = good();
  const auto at = [&](double x, double y) { return read.materials[read.terrain.materialAt({kX + x, kY + y})]; };
  EXPECT_EQ(at(5, 5), "meadow");
  EXPECT_EQ(at(15, 15), "scree") << "the hole";
  EXPECT_EQ(at(35, 35), "meadow") << "the map is later in the list than the square";
  EXPECT_EQ(at(52, 35), "stone");
  EXPECT_EQ(at(57, 62), "scree") << "the triangle is later than the map";
  EXPECT_EQ(at(75, 50), "meadow") << "null means nothing of its own, the first polygon counts";
  EXPECT_EQ(read.notes.at(0).text, "soils.geojson: 4 features, 1 of them beyond the terrain");
}

TEST_F(Maps, ZonesOfARaster) {
  Raster soils{10, 10, 5, kX + 2.5, kY + 2.5, std::vector<double>(100, 1), {}};
  soils.at(3, 4) = 2;
  soils.at(5, 5) = std::nan("");
  soils.at(6, 6) = 0;
  ASSERT_TRUE(writeGeoTiff(path("soils.tif"), soils));
  case_["terrain"]["zones"] = {
      {{"raster", "soils.tif"}, {"materials", {{"1", "meadow"}, {"2", "stone"}, {"0", nullptr}}}}};
  const Case read = good();
  const auto at = [&](double x, double y) { return read.materials[read.terrain.materialAt({kX + x, kY + y})]; };
  EXPECT_EQ(at(1, 1), "meadow");
  EXPECT_EQ(at(17, 22), "stone");
  EXPECT_EQ(at(27, 27), "scree") << "no value";
  EXPECT_EQ(at(32, 32), "scree") << "null";
  EXPECT_EQ(at(60, 60), "scree") << "beyond the raster";
}

TEST_F(Maps, TreesByClassesAndOneByOne) {
  test::writeMap(path("forest.geojson"), {{rectangle(kX, kY, kX + 100, kY + 50), {{"type", "dense"}}},
                                          {rectangle(kX, kY + 50, kX + 100, kY + 100), {{"type", "open"}}},
                                          {rectangle(kX, kY + 100, kX + 10, kY + 110), {{"type", "none"}}}});
  const json stands{{"dense", {{"density_per_ha", 400}, {"diameter_m", {0.2, 0.4}}}},
                    {"open", {{"density_per_ha", 100}, {"diameter_m", {0.5, 0.6}}}},
                    {"none", nullptr}};
  case_["effects"] = {
      {{"effect", "trees"}, {"stems", {{"vector", "forest.geojson"}, {"field", "type"}, {"stands", stands}}}}};
  const auto stemsOf = [](const Case& read) {
    return std::get<std::vector<Stem>>(std::get<TreesOptions>(read.effects.at(0)).stems);
  };
  const std::vector<Stem> stems = stemsOf(good());
  ASSERT_EQ(stems.size(), 200U + 50U) << "half a hectare of each";
  for (const Stem& stem : stems) {
    const bool isDense = stem.placeM[1] < kY + 50;
    EXPECT_TRUE(isDense ? stem.diameterM >= 0.2 && stem.diameterM < 0.4
                        : stem.diameterM >= 0.5 && stem.diameterM < 0.6);
    EXPECT_TRUE(stem.placeM[0] >= kX && stem.placeM[0] <= kX + 100 && stem.placeM[1] <= kY + 100);
  }
  const std::vector<Stem> again = stemsOf(good());
  EXPECT_EQ(again[77].placeM, stems[77].placeM) << "a pure function of the case";
  case_["seed"] = 2;
  EXPECT_NE(stemsOf(good())[77].placeM, stems[77].placeM);

  Raster forest{10, 10, 10, kX + 5, kY + 5, std::vector<double>(100, std::nan("")), {}};
  forest.at(2, 3) = 7;
  ASSERT_TRUE(writeGeoTiff(path("forest.tif"), forest));
  case_["effects"][0]["stems"] = {{"raster", "forest.tif"}, {"stands", {{"7", stands["dense"]}}}};
  const std::vector<Stem> ofCell = stemsOf(good());
  ASSERT_EQ(ofCell.size(), 4U);
  for (const Stem& stem : ofCell)
    EXPECT_TRUE(stem.placeM[0] >= kX + 20 && stem.placeM[0] < kX + 30 && stem.placeM[1] >= kY + 30 &&
                stem.placeM[1] < kY + 40);

  test::writeMap(path("beeches.geojson"), {{pointAt(kX + 5, kY + 6), {{"dbh_m", 0.45}}}});
  case_["effects"][0]["stems"] = {{"vector", "beeches.geojson"}, {"diameter_field", "dbh_m"}};
  ASSERT_EQ(stemsOf(good()).size(), 1U);
  EXPECT_EQ(stemsOf(good())[0].diameterM, 0.45);
  test::writeMap(path("beeches.geojson"), {{pointAt(kX + 5, kY + 6), {{"dbh_m", 45}}}});
  EXPECT_NE(refusal().find("no stem is 45 m thick"), std::string::npos) << refusal();
  test::writeMap(path("beeches.geojson"), {{pointAt(kX + 5, kY + 6), {{"dbh_m", nullptr}}}});
  EXPECT_NE(refusal().find("its diameter is missing"), std::string::npos) << refusal();
}

TEST_F(Maps, CollectorsAndBarriersOfSeveralParts) {
  test::writeMap(
      path("lines.geojson"),
      {{{{"type", "MultiLineString"},
         {"coordinates",
          {{{kX + 60, kY}, {kX + 60, kY + 50}}, {{kX + 60, kY + 60}, {kX + 65, kY + 90}, {kX + 65, kY + 95}}}}}},
       {lineOf({{kX + 70, kY}, {kX + 71, kY}})}});
  case_["collectors"] = {{{"name", "road"}, {"vector", "lines.geojson"}, {"layer", "lines"}}};
  case_["effects"] = {{{"effect", "barrier"}, {"vector", "lines.geojson"}, {"height_m", 4}, {"capacity_j", 1e6}}};
  const Case read = good();
  EXPECT_EQ(read.collectors[0].lines.size(), 3U);
  EXPECT_EQ(read.collectors[0].lines[1].size(), 3U);
  EXPECT_EQ(std::get<BarrierOptions>(read.effects[0]).lines, read.collectors[0].lines);
}

TEST_F(Maps, LeavesOutNullGeometriesAndTellsIt) {
  test::writeMap(path("road.geojson"), {{nullptr},
                                        {lineOf({{kX + 30, kY + 20}, {kX + 40, kY + 140}})},
                                        {{{"type", "LineString"}, {"coordinates", json::array()}}}});
  case_["collectors"] = {{{"name", "road"}, {"vector", "road.geojson"}}};
  EXPECT_EQ(good().notes.at(0).text, "road.geojson: 1 features, and 2 without a place left out");
}

}  // namespace
}  // namespace cairn::rockfall::maps_test
