// SPDX-License-Identifier: GPL-3.0-or-later
// GeoTIFF by GDAL, where it is installed; a named error where it is not.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "cairn/core/atomic_file.h"
#include "random_tree.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall::geo_raster_test {
namespace {

using test::uniform;

class GeoRaster : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("cairn_geo_raster_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  std::filesystem::path folder_;
};

Raster randomRaster(std::mt19937_64& engine, bool isFloat) {
  Raster raster;
  raster.columns = 1 + static_cast<std::uint32_t>(engine() % 40);
  raster.rows = 1 + static_cast<std::uint32_t>(engine() % 40);
  // Quarters, so that corners and middles of cells have no roundings.
  raster.cell = 0.25 * static_cast<double>(1 + engine() % 100);
  raster.x = 2600000.125 + raster.cell;
  raster.y = 1200000.5;
  for (std::uint32_t i = 0; i < raster.columns * raster.rows; ++i) {
    const double value = uniform(engine, -100, 4000);
    raster.values.push_back(engine() % 9 == 0 ? std::nan("") : isFloat ? double(static_cast<float>(value)) : value);
  }
  return raster;
}

TEST_F(GeoRaster, ReadsBackWhatItWrote) {
  if (!hasGdal()) GTEST_SKIP() << "built without GDAL";
  constexpr std::uint64_t kSeed = 62;
  std::mt19937_64 engine(kSeed);
  for (int trial = 0; trial < 30; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const Raster raster = randomRaster(engine, trial % 2 == 0);
    const Status written = writeGeoTiff(file("a.tif"), raster);
    ASSERT_TRUE(written) << written.error().message;
    const Result<Raster> read = readRaster(file("a.tif"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read.value().columns, raster.columns);
    EXPECT_EQ(read.value().rows, raster.rows);
    EXPECT_EQ(read.value().cell, raster.cell);
    // A map's coordinates in double, some roundings apart.
    EXPECT_NEAR(read.value().x, raster.x, 1e-8);
    EXPECT_NEAR(read.value().y, raster.y, 1e-8);
    for (std::size_t i = 0; i < raster.values.size(); ++i)
      ASSERT_TRUE(read.value().values[i] == raster.values[i] ||
                  (std::isnan(read.value().values[i]) && std::isnan(raster.values[i])));
  }
}

TEST_F(GeoRaster, KeepsTheProjection) {
  if (!hasGdal()) GTEST_SKIP() << "built without GDAL";
  Raster raster{2, 2, 1, 0, 0, {1, 2, 3, 4}, {}};
  raster.projection =
      "PROJCS[\"x\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
      "84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
      "UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
      "PARAMETER[\"central_meridian\",9],PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"
      "PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]";
  ASSERT_TRUE(writeGeoTiff(file("a.tif"), raster));
  const Result<Raster> read = readRaster(file("a.tif"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_NE(read.value().projection.find("Transverse_Mercator"), std::string::npos);
  // A raster from GDAL can be written again.
  ASSERT_TRUE(writeGeoTiff(file("b.tif"), read.value()));

  raster.projection =
      "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
      "UNIT[\"degree\",0.0174532925199433]]";
  ASSERT_TRUE(writeGeoTiff(file("c.tif"), raster));
  const Result<Raster> degrees = readRaster(file("c.tif"));
  ASSERT_FALSE(degrees);
  EXPECT_EQ(
      degrees.error().message,
      file("c.tif").string() + " is in degrees: project it to metres first, for example by gdalwarp -t_srs EPSG:25832");
}

TEST_F(GeoRaster, RefusesInOneSentence) {
  const std::string name = file("none.tif").string();
  const Result<Raster> missing = readRaster(name);
  ASSERT_FALSE(missing);
  std::ofstream(file("text.tif")) << "no raster\n";
  const Result<Raster> text = readRaster(file("text.tif"));
  ASSERT_FALSE(text);
  const Status folder = writeGeoTiff(file("no folder") / "a.tif", {1, 1, 1, 0, 0, {1}, {}});
  ASSERT_FALSE(folder);
  for (const std::string& message : {missing.error().message, text.error().message, folder.error().message}) {
    EXPECT_TRUE(message.starts_with(folder_.string())) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  if (hasGdal())
    EXPECT_EQ(missing.error().message, name + ": is no file that can be read");
  else
    EXPECT_NE(missing.error().message.find("built without GDAL"), std::string::npos);
}

// Truncated and overwritten: read or refused, never more.
TEST_F(GeoRaster, SurvivesDamagedFiles) {
  if (!hasGdal()) GTEST_SKIP() << "built without GDAL";
  constexpr std::uint64_t kSeed = 63;
  std::mt19937_64 engine(kSeed);
  ASSERT_TRUE(writeGeoTiff(file("a.tif"), randomRaster(engine, false)));
  const auto whole = readFile(file("a.tif"));
  ASSERT_TRUE(whole);
  int refused = 0;
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    std::vector<std::byte> bytes = whole.value();
    if (trial % 2 == 0) bytes.resize(engine() % bytes.size());
    for (int change = 0; change < 8 && !bytes.empty(); ++change)
      bytes[engine() % bytes.size()] = static_cast<std::byte>(engine());
    ASSERT_TRUE(writeFileAtomically(file("b.tif"), bytes));
    const Result<Raster> read = readRaster(file("b.tif"));
    if (read) {
      ASSERT_EQ(read.value().values.size(), std::size_t(read.value().columns) * read.value().rows);
    } else {
      ++refused;
      ASSERT_EQ(read.error().message.find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace cairn::rockfall::geo_raster_test
