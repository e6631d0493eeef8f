// SPDX-License-Identifier: GPL-3.0-or-later
// ESRI ASCII grids: what is written reads back as itself, whatever else a file says is refused in one sentence.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "random_tree.h"
#include "rockfall/terrain/ascii_grid.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall::ascii_grid_test {
namespace {

using test::uniform;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Exactly, NaN where NaN is.
void expectSame(const Raster& a, const Raster& b) {
  ASSERT_EQ(a.columns, b.columns);
  ASSERT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.cell, b.cell);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  for (std::size_t i = 0; i < a.values.size(); ++i)
    ASSERT_TRUE(a.values[i] == b.values[i] || (std::isnan(a.values[i]) && std::isnan(b.values[i]))) << i;
}

Raster randomRaster(std::mt19937_64& engine) {
  Raster raster;
  raster.columns = 1 + static_cast<std::uint32_t>(engine() % 12);
  raster.rows = 1 + static_cast<std::uint32_t>(engine() % 12);
  raster.cell = std::pow(10, uniform(engine, -2, 2));
  raster.x = uniform(engine, -3e6, 3e6);
  raster.y = uniform(engine, -3e6, 3e6);
  for (std::uint32_t i = 0; i < raster.columns * raster.rows; ++i)
    raster.values.push_back(engine() % 5 == 0 ? kNone : engine() % 7 == 0 ? -9999 : uniform(engine, -5000, 9000));
  return raster;
}

TEST(AsciiGrid, ReadsBackWhatItWrote) {
  constexpr std::uint64_t kSeed = 60;
  std::mt19937_64 engine(kSeed);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const Raster raster = randomRaster(engine);
    const std::string text = asciiGrid(raster);
    EXPECT_EQ(text.find("xllcorner") == std::string::npos, text.find("yllcorner") == std::string::npos)
        << "both corners or both centres: GDAL reads no mixture";
    const Result<Raster> read = parseAsciiGrid(text, "text");
    ASSERT_TRUE(read) << read.error().message;
    expectSame(read.value(), raster);
  }
}

TEST(AsciiGrid, KnowsCornersAndCentersAndWhereNorthIs) {
  const std::string values = "cellsize 2\nNODATA_value -1\n1 2 3\n4 -1 6\n";
  const Result<Raster> corner = parseAsciiGrid("ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\n" + values, "text");
  const Result<Raster> center =
      parseAsciiGrid("NCOLS 3\r\nNROWS 2\r\nXLLCENTER 11\r\nYLLCENTER 21\r\n" + values, "text");
  ASSERT_TRUE(corner && center);
  expectSame(corner.value(), center.value());
  expectSame(corner.value(), {3, 2, 2, 11, 21, {4, kNone, 6, 1, 2, 3}, {}});
  // Without NODATA_value it is -9999; lines may end anywhere.
  const Result<Raster> usual = parseAsciiGrid("ncols 2 nrows 1 xllcenter 0 yllcenter 0 cellsize 1 -9999\n+1e1", "text");
  ASSERT_TRUE(usual);
  expectSame(usual.value(), {2, 1, 1, 0, 0, {kNone, 10}, {}});
  const Result<Raster> nan =
      parseAsciiGrid("ncols 2 nrows 1 xllcenter 0 yllcenter 0 cellsize 1 NODATA_value nan\nnan 3", "text");
  ASSERT_TRUE(nan);
  expectSame(nan.value(), {2, 1, 1, 0, 0, {kNone, 3}, {}});
}

TEST(AsciiGrid, ReadsWhatOtherProgramsWrite) {
  const std::string head = "ncols 3\nnrows 1\nxllcenter 0\nyllcenter 0\n";
  const auto expectRead = [&](const std::string& rest, const std::vector<double>& values) {
    const Result<Raster> read = parseAsciiGrid(head + rest, "text");
    ASSERT_TRUE(read) << read.error().message;
    expectSame(read.value(), {3, 1, 2, 0, 0, values, {}});
  };
  // the least float, with all its digits and with as many as a float needs
  expectRead("cellsize 2\nNODATA_value -3.4028234663852886e+38\n-3.4028235e+38 2 3\n", {kNone, 2, 3});
  expectRead("cellsize 2\nNODATA_value -3.4028235e+38\n1 -3.4028234663852886e+38 3\n", {1, kNone, 3});
  expectRead("cellsize 2\nNODATA_value -9999\nnan NaN 3\n", {kNone, kNone, 3});
  expectRead("cellsize 2\nNODATA_value -9999\n-9998.99 -9999.00000001 0\n", {-9998.99, kNone, 0});
  expectRead("cellsize 2\nNODATA_value 0\n1e-30 0 3\n", {1e-30, kNone, 3});
  expectRead("dx 2\ndy 2\nNODATA_value -1\n1 -1 3\n", {1, kNone, 3});
  expectRead("DX 2\nDY 2.000000000001\n1 2 3\n", {1, 2, 3});
}

std::string refusal(const std::string& text) {
  const Result<Raster> read = parseAsciiGrid(text, "dem.asc");
  return read ? "accepted" : read.error().message;
}

TEST(AsciiGrid, RefusesInOneSentenceWithTheLine) {
  const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  EXPECT_EQ(refusal(head + "1 2\n3 4\n"), "accepted");
  EXPECT_EQ(refusal(""), "dem.asc, line 1: found \"\" where ncols has to be");
  EXPECT_EQ(refusal("ncols 2.5\n"), "dem.asc, line 1: ncols is \"2.5\": give a positive whole number");
  EXPECT_EQ(refusal("ncols -2\n"), "dem.asc, line 1: ncols is \"-2\": give a positive whole number");
  EXPECT_EQ(refusal("ncols 99999999999\n"), "dem.asc, line 1: ncols is \"99999999999\": give a positive whole number");
  EXPECT_EQ(refusal("ncols 2\nrows 2\n"), "dem.asc, line 2: found \"rows\" where nrows has to be");
  EXPECT_EQ(refusal("ncols 2\nnrows 2\nxll 2\n"),
            "dem.asc, line 3: found \"xll\" where xllcorner or xllcenter has to be");
  EXPECT_EQ(refusal("ncols 2\nnrows 2\nxllcorner inf\n"),
            "dem.asc, line 3: xllcorner is \"inf\": give a finite number");
  EXPECT_EQ(refusal("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n"),
            "dem.asc, line 5: cellsize is not positive: give the distance of two values in metres");
  EXPECT_EQ(refusal(head + "NODATA_value none\n"), "dem.asc, line 6: NODATA_value is \"none\": give a number");
  EXPECT_EQ(refusal(head + "1 2\n3 x\x01\n"),
            "dem.asc, line 7: the value is \"x?\": give a finite number or NODATA_value");
  EXPECT_EQ(refusal(head + "1 2\ninf 3\n"),
            "dem.asc, line 7: the value is \"inf\": give a finite number or NODATA_value");
  EXPECT_EQ(refusal("ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ndx 2\ndy 3\n1 2\n"),
            "dem.asc, line 6: has cells of 2.000000 x 3.000000 m: warp it to square ones first");
  EXPECT_EQ(refusal("ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ndx -2\ndy -2\n1 2\n"),
            "dem.asc, line 5: dx is not positive: give the distance of two values in metres");
  EXPECT_EQ(refusal("ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ndx 2\n1 2\n"),
            "dem.asc, line 6: found \"1\" where dy has to be");
  EXPECT_EQ(refusal(head + "1 2\n3   \n"), "dem.asc, line 8: the file ends after 3 of 4 values");
  EXPECT_EQ(refusal(head + "1 2\n3 4\n5\n"), "dem.asc, line 8: found \"5\" after the last value");
  EXPECT_EQ(refusal("ncols 1000000\nnrows 200\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n"),
            "dem.asc is too short for 200000000 values: it may have been cut off");
  EXPECT_EQ(refusal("ncols 1000000\nnrows 1000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n"),
            "dem.asc has 1000000 x 1000000 values: give at least one, and at most 2^20 a side and 2^28 in all");
}

// Whatever is changed in a file: it is read, or refused in one sentence.
TEST(AsciiGrid, SurvivesDamagedFiles) {
  constexpr std::uint64_t kSeed = 61;
  std::mt19937_64 engine(kSeed);
  int refused = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    std::string text = asciiGrid(randomRaster(engine));
    for (std::uint64_t change = 1 + engine() % 4; change > 0 && !text.empty(); --change) {
      const std::size_t at = engine() % text.size();
      if (engine() % 3 == 0)
        text.resize(at);
      else if (engine() % 2 == 0)
        text[at] = static_cast<char>(engine());
      else
        text.insert(at, text.substr(engine() % text.size(), engine() % 20));
    }
    const Result<Raster> read = parseAsciiGrid(text, "text");
    if (read) {
      ASSERT_EQ(read.value().values.size(), std::size_t(read.value().columns) * read.value().rows);
      continue;
    }
    ++refused;
    ASSERT_TRUE(read.error().message.starts_with("text"));
    ASSERT_EQ(read.error().message.find('\n'), std::string::npos);
  }
  EXPECT_GT(refused, 1000);
}

TEST(AsciiGrid, IsWrittenCompletelyOrNotAtAll) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "cairn_ascii_grid_test.asc";
  const Raster raster{2, 2, 1, 0.5, 0.5, {1, 2, kNone, 4}, {}};
  ASSERT_TRUE(writeAsciiGrid(path, raster));
  const Result<Raster> read = readRaster(path);
  ASSERT_TRUE(read) << read.error().message;
  expectSame(read.value(), raster);
  std::filesystem::remove(path);
  EXPECT_FALSE(readRaster(path));
  EXPECT_FALSE(writeAsciiGrid(path / "no such folder" / "x.asc", raster));
}

TEST(RasterAsTerrain, KeepsMountainsPreciseInFloat) {
  const Raster raster{3, 2, 10, 2.6e6, 1.2e6, {4478.0371, 4500.1234, kNone, 4600.9876, 4477.25, 4499.5}, {}};
  const Result<bullet::TerrainGrid> grid = terrainGridOf(raster);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid.value().origin.z, 4477);
  const Raster back = rasterOf(grid.value());
  // Heights up to 128 m over the origin: half a unit in the last place of float.
  for (std::size_t i = 0; i < raster.values.size(); ++i)
    if (i != 2) EXPECT_NEAR(back.values[i], raster.values[i], 64 * 1.2e-7);
  EXPECT_TRUE(std::isnan(back.values[2]));
  EXPECT_TRUE(bullet::TerrainShape::create(grid.value()));
  EXPECT_FALSE(terrainGridOf({1, 1, 1, 0, 0, {kNone}, {}}));
  EXPECT_TRUE(terrainGridOf({1, 1, 1, 5e8, -6e6, {1}, {}}));
  EXPECT_EQ(terrainGridOf({1, 1, 1, 1e300, 0, {1}, {}}).error().message,
            "lies at (1e+300, 0), too far from 0 for cells of 1 m: move it nearer");
  EXPECT_FALSE(terrainGridOf({1, 1, 1, 0, -1e13, {1}, {}}));
}

}  // namespace
}  // namespace cairn::rockfall::ascii_grid_test
