// SPDX-License-Identifier: GPL-3.0-or-later
// Rasters that are read without complaint and hold something else than heights in metres.
#include "rockfall/terrain/height_traps.h"

#include <gtest/gtest.h>

#include <limits>

namespace cairn::rockfall::height_traps_test {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string why(const Raster& raster) {
  return whyNoHeights(raster).value_or("");
}

TEST(HeightTraps, AreNoneInOrdinaryMaps) {
  EXPECT_EQ(why({2, 2, 1, 500000, 5e6, {400, 410, kNone, 405}, {}}), "");
  EXPECT_EQ(why({2, 2, 1, 0, 0, {-9999, -9998, -9990, -9000}, {}}), "") << "the bottom of the sea";
  EXPECT_EQ(why({2, 2, 0.01, 0, 0, {0, 0.05, 0.01, 0}, {}}), "") << "a model on a table";
  EXPECT_EQ(why({2, 2, 30, 10, 40, {400, 1200, 800, 500}, {}}), "") << "a map with an origin of its own";
}

TEST(HeightTraps, AreNumbersForNoValueThatNobodyDeclared) {
  for (const double number :
       {-9999.0, -32768.0, -99999.0, -double(std::numeric_limits<float>::max()), -3.4028235e+38}) {
    const std::string told = why({2, 2, 1, 5e5, 5e6, {400, number, number, 405}, {}});
    EXPECT_NE(told.find("in 2 of its cells"), std::string::npos) << number << " " << told;
    EXPECT_NE(told.find("gdal_translate -a_nodata"), std::string::npos);
  }
  EXPECT_NE(why({2, 1, 1, 0, 0, {-9999, -9999}, {}}), "") << "nothing else there";
  EXPECT_NE(why({2, 2, 1, 5e5, 5e6, {1400, 0, 0, 1405}, {}}), "") << "a hole in the Alps";
  EXPECT_EQ(why({2, 2, 1, 5e5, 5e6, {0, 0, 0, 0}, {}}), "") << "a flat map";
  EXPECT_EQ(why({2, 2, 1, 5e5, 5e6, {400, 0, 3, 405}, {}}), "") << "a coast";
}

TEST(HeightTraps, AreDegrees) {
  const std::string told = why({3, 2, 0.0003, 10.2, 46.7, {1200, 1210, 1190, 1180, 1400, 1350}, {}});
  EXPECT_NE(told.find("in degrees"), std::string::npos) << told;
  EXPECT_NE(told.find("gdalwarp"), std::string::npos) << told;
}

}  // namespace
}  // namespace cairn::rockfall::height_traps_test
