// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/height_traps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cairn::rockfall {
namespace {

/// What programs write where there is no value: zero, as whole numbers, and the least and greatest float.
constexpr double kGreatestFloat = std::numeric_limits<float>::max();
constexpr std::array kUsualNoValues{0.0,      -9999.0, -99999.0,        -32768.0,
                                    -32767.0, 32767.0, -kGreatestFloat, kGreatestFloat};
/// m; ground so much lower or higher than all other ground is none.
constexpr double kApart = 1000;
/// Of a map's longer side: no map of mountains is as high as it is long ten times over.
constexpr double kSteepest = 10;
constexpr double kWidestDegreeCell = 0.05;  // 5 km

struct Heights {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// In single precision, of which programs print more digits or fewer.
bool isNumber(double value, double number) {
  return std::abs(value - number) <= 0x1p-24 * std::abs(number);
}

/// The heights but for one number.
Heights heightsWithout(const Raster& raster, double number) {
  Heights heights;
  for (const double value : raster.values) {
    if (std::isnan(value) || isNumber(value, number)) continue;
    heights.low = std::min(heights.low, value);
    heights.high = std::max(heights.high, value);
  }
  return heights;
}

std::optional<std::string> undeclared(const Raster& raster) {
  for (const double number : kUsualNoValues) {
    const auto count = std::ranges::count_if(raster.values, [&](double value) { return isNumber(value, number); });
    if (count == 0) continue;
    const Heights others = heightsWithout(raster, number);
    const bool hasOthers = others.low <= others.high;  // a map may be flat at height 0
    const bool isApart = hasOthers ? number < others.low - kApart || number > others.high + kApart : number != 0;
    if (isApart)
      return fmt::format(
          "holds {:g} in {} of its cells, far from all other heights: if there is no ground, declare that number as "
          "NODATA, for example by gdal_translate -a_nodata {:.9g}",
          number, count, number);
  }
  return {};
}

std::optional<std::string> inDegrees(const Raster& raster) {
  const double toX = raster.x + raster.cell * (raster.columns - 1), toY = raster.y + raster.cell * (raster.rows - 1);
  const bool isOnGlobe = std::max(std::abs(raster.x), std::abs(toX)) <= 180 &&
                         std::max(std::abs(raster.y), std::abs(toY)) <= 90 && raster.cell <= kWidestDegreeCell;
  const double longer = std::max(toX - raster.x, toY - raster.y);
  const Heights heights = heightsWithout(raster, std::numeric_limits<double>::quiet_NaN());
  if (!isOnGlobe || !(heights.high - heights.low > kSteepest * longer)) return {};
  return fmt::format(
      "seems to be in degrees: heights from {:g} to {:g} over {:g} of the map; project it to metres first, for example "
      "by gdalwarp -s_srs EPSG:4326 -t_srs EPSG:25832",
      heights.low, heights.high, longer);
}

}  // namespace

std::optional<std::string> whyNoHeights(const Raster& raster) {
  if (auto why = undeclared(raster)) return why;
  return inDegrees(raster);
}

}  // namespace cairn::rockfall
