// SPDX-License-Identifier: GPL-3.0-or-later
// Maps in cases that are refused, damaged or of other coordinates. GDAL's own programs
// write the files that are not GeoJSON.
#include "maps_fixture.h"

namespace cairn::rockfall::maps_test {
namespace {

TEST_F(Maps, RefusesInOneSentence) {
  struct Bad {
    std::vector<FeatureToWrite> features;
    int epsg;
    const char* sentence;
  };
  const auto bowTie =
      json{{"type", "Polygon"},
           {"coordinates",
            {{{kX + 12, kY + 60}, {kX + 22, kY + 70}, {kX + 22, kY + 60}, {kX + 12, kY + 70}, {kX + 12, kY + 60}}}}};
  for (const Bad& bad : std::vector<Bad>{
           {{}, 2056, "/rocks/0/release/vector: map.geojson holds no points or lines or polygons"},
           {{{nullptr}},
            2056,
            "/rocks/0/release/vector: map.geojson holds no points or lines or polygons: none of its 1 features has a "
            "place"},
           {{{bowTie}},
            2056,
            "/rocks/0/release/vector: map.geojson feature 0: it crosses or touches itself: Self-intersection"},
           {{{pointAt(kX + 15, kY + 70)}, {kCliff}},
            2056,
            "/rocks/0/release/vector: map.geojson feature 1: it has polygons, others have points: give them as layers "
            "of their own"},
           {{{pointAt(kX - 500, kY)}},
            2056,
            "/rocks/0/release/vector: map.geojson lies wholly outside the terrain, which covers x from"},
           {{{pointAt(kX + 15, kY + 70)}, {pointAt(kX - 500, kY)}},
            2056,
            "/rocks/0/release/vector: map.geojson feature 1: its place (2600720, 1163420) is outside the terrain"},
           {{{pointAt(1e9, kY)}},
            2056,
            "/rocks/0/release/vector: map.geojson feature 0: its place (1000000000, 1163420) is on no map in metres"},
           {{{pointAt(kX + 15, kY + 70)}},
            0,
            "/rocks/0/release/vector: map.geojson feature 0: its coordinates are no degrees, though the file says so"},
           {{{pointAt(151.2, -33.9)}}, 4326, "/rocks/0/release/vector: map.geojson "},
       }) {
    test::writeMap(path("map.geojson"), bad.features, bad.epsg);
    release({{"vector", "map.geojson"}});
    EXPECT_TRUE(refusal().starts_with(bad.sentence)) << refusal() << "\nnot: " << bad.sentence;
  }
}

TEST_F(Maps, RefusesLayersFieldsAndClassesByName) {
  if (!test::hasGdalPrograms()) GTEST_SKIP() << "needs Debian's package gdal-bin";
  test::writeMap(path("cliff.geojson"), {{kCliff, {{"kind", "cliff"}}}});
  for (const char* layer : {"east", "west"})
    test::gdal("ogr2ogr -f GPKG -update -append " + path("two.gpkg").string() + " " + path("cliff.geojson").string() +
               " -nln " + layer);
  release({{"vector", "two.gpkg"}});
  EXPECT_EQ(refusal(), "/rocks/0/release/vector: two.gpkg holds 2 layers: name one of them as \"layer\": east, west");
  release({{"vector", "two.gpkg"}, {"layer", "north"}});
  EXPECT_EQ(refusal(), "/rocks/0/release/vector: two.gpkg has no layer \"north\": it holds east, west");
  release({{"vector", "two.gpkg"}, {"layer", "west"}});
  EXPECT_FALSE(good().rocks[0].release.places.empty());
  case_["terrain"]["zones"] = {{{"vector", "cliff.geojson"}, {"field", "sort"}, {"materials", {{"cliff", "stone"}}}}};
  EXPECT_EQ(refusal(), "/terrain/zones/0/vector: cliff.geojson has no field \"sort\": it has kind");
  case_["terrain"]["zones"] = {{{"vector", "cliff.geojson"}, {"field", "kind"}, {"materials", {{"scree", "stone"}}}}};
  EXPECT_EQ(refusal(),
            "/terrain/zones/0/vector: cliff.geojson feature 0: the class \"cliff\" has no meaning in the "
            "case: list it, with null if there is nothing there");
}

TEST_F(Maps, RefusesOtherCoordinatesOfRastersAndUnknownOnes) {
  case_["terrain"]["crs"] = "EPSG:999999";
  EXPECT_EQ(refusal(),
            "/terrain/crs: \"EPSG:999999\" is no coordinate system that is known: give a name such as EPSG:2056");
  case_["terrain"]["crs"] = "EPSG:4326";
  EXPECT_EQ(refusal(),
            "/terrain/crs: \"EPSG:4326\" is in degrees: project it to metres first, for example by gdalwarp -t_srs "
            "EPSG:25832");
  case_["terrain"]["crs"] = "http://example.org/crs";
  EXPECT_NE(refusal().find("is no coordinate system that is known"), std::string::npos) << refusal();
  case_["terrain"].erase("crs");
  test::writeMap(path("cliff.geojson"), {{kCliff}});
  release({{"vector", "cliff.geojson"}});
  EXPECT_EQ(refusal(),
            "/rocks/0/release/vector: cliff.geojson is in EPSG:2056, but the terrain does not say in which "
            "coordinates it is: give its \"crs\" under /terrain, as in \"crs\": \"EPSG:2056\"");
  if (!test::hasGdalPrograms()) return;
  case_["terrain"]["crs"] = "EPSG:2056";
  Raster mask{4, 4, 1, kX + 10.5, kY + 60.5, std::vector<double>(16, 1), {}};
  ASSERT_TRUE(writeGeoTiff(path("plain.tif"), mask));
  test::gdal("gdal_translate -a_srs EPSG:25832 " + path("plain.tif").string() + " " + path("mask.tif").string());
  release({{"raster", "mask.tif"}});
  EXPECT_EQ(refusal(),
            "/rocks/0/release/raster: mask.tif is in EPSG:25832, the terrain in EPSG:2056: warp it first, by "
            "gdalwarp -r near -t_srs");
}

TEST_F(Maps, OfAGridsPrjAreTheCases) {
  if (!test::hasGdalPrograms()) GTEST_SKIP() << "needs Debian's package gdal-bin";
  std::ofstream(path("gully.prj")) << test::gdal("gdalsrsinfo -o wkt_esri EPSG:2056");
  test::writeMap(path("cliff.geojson"), {{kCliff}});
  release({{"vector", "cliff.geojson"}});
  EXPECT_FALSE(good().rocks[0].release.places.empty()) << "the same said twice";
  case_["terrain"].erase("crs");
  EXPECT_FALSE(good().rocks[0].release.places.empty());
  case_["terrain"]["crs"] = "EPSG:25832";
  EXPECT_EQ(
      refusal(),
      "/terrain/crs: the terrain's file says that it is in EPSG:2056, not in \"EPSG:25832\": leave one of them out");
  std::ofstream(path("gully.prj")) << "no projection";
  EXPECT_NE(refusal().find("gully.prj holds no coordinate system that can be read"), std::string::npos) << refusal();
}

TEST_F(Maps, ChangeTheHashWithAllTheirFiles) {
  if (!test::hasGdalPrograms()) GTEST_SKIP() << "needs Debian's package gdal-bin";
  test::writeMap(path("soils.geojson"), {{kCliff, {{"class", 1}}}});
  test::gdal("ogr2ogr -f 'ESRI Shapefile' " + path("soils.shp").string() + " " + path("soils.geojson").string());
  case_["terrain"]["zones"] = {{{"vector", "soils.shp"}, {"field", "class"}, {"materials", {{"1", "stone"}}}}};
  const std::string before = good().hash;
  EXPECT_EQ(good().hash, before);
  std::string table = test::contentOf(path("soils.dbf"));
  table[1] = static_cast<char>(table[1] + 1);  // the date of its last change
  std::ofstream(path("soils.dbf"), std::ios::binary) << table;
  EXPECT_NE(good().hash, before);
  case_["terrain"]["zones"][0]["vector"] = "none.shp";
  EXPECT_NE(refusal().find("/terrain/zones/0/vector"), std::string::npos) << refusal();
}

// Truncated and overwritten: read or refused in one sentence, never more.
TEST_F(Maps, SurviveDamagedFiles) {
  if (!test::hasGdalPrograms()) GTEST_SKIP() << "needs Debian's package gdal-bin";
  test::writeMap(path("whole.geojson"), {{kCliff, {{"kind", "cliff"}}}, {kCliff, {{"kind", "edge"}}}});
  test::gdal("ogr2ogr -f GPKG " + path("whole.gpkg").string() + " " + path("whole.geojson").string());
  test::gdal("ogr2ogr -f 'ESRI Shapefile' " + path("whole.shp").string() + " " + path("whole.geojson").string());
  constexpr unsigned kSeed = 11;
  std::mt19937 engine(kSeed);
  int refused = 0;
  for (const char* format : {"geojson", "gpkg", "shp"})
    for (int trial = 0; trial < 60; ++trial) {
      SCOPED_TRACE(fmt::format("seed {}, {} {}", kSeed, format, trial));
      std::string bytes = test::contentOf(path(std::string("whole.") + format));
      if (trial % 2 == 0) bytes.resize(engine() % bytes.size());
      for (int change = 0; change < 8 && !bytes.empty(); ++change)
        bytes[engine() % bytes.size()] = static_cast<char>(engine());
      std::ofstream(path(std::string("bad.") + format), std::ios::binary) << bytes;
      release({{"vector", std::string("bad.") + format}});
      const auto all = read();
      refused += !all;
      if (!all) ASSERT_EQ(all.error().message.find('\n'), std::string::npos) << all.error().message;
    }
  EXPECT_GT(refused, 60);
}

TEST(MapsWithoutGdal, AreRefusedByName) {
  if (hasGdal()) GTEST_SKIP() << "built with GDAL";
  const auto layer = readMapLayer({"cliff.gpkg", {}, {}, {}});
  ASSERT_FALSE(layer);
  EXPECT_EQ(layer.error().message,
            "cliff.gpkg: this program was built without GDAL, which vector maps need: install libgdal-dev and build "
            "again, or give the coordinates in the case");
}

}  // namespace
}  // namespace cairn::rockfall::maps_test
