// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/raster.h"

#include <cmath>
#include <limits>
#include <utility>

namespace cairn::rockfall {

RasterFrame rasterFrame(const Ground& ground, double cellM) {
  const auto cellOf = [&](double coordinate) { return static_cast<std::int32_t>(std::floor(coordinate / cellM)); };
  RasterFrame frame{cellM, cellOf(ground.lower().x), cellOf(ground.lower().y), 0, 0};
  // No point over the ground lies on its upper edge.
  frame.columns = static_cast<std::int32_t>(std::ceil(ground.upper().x / cellM)) - frame.firstColumn;
  frame.rows = static_cast<std::int32_t>(std::ceil(ground.upper().y / cellM)) - frame.firstRow;
  return frame;
}

Raster rasterOf(const RasterFrame& frame, const MergedRuns& merged,
                const std::function<double(const CellSummary&)>& value) {
  Raster raster{static_cast<std::uint32_t>(frame.columns),
                static_cast<std::uint32_t>(frame.rows),
                frame.cellM,
                (frame.firstColumn + 0.5) * frame.cellM,
                (frame.firstRow + 0.5) * frame.cellM,
                {},
                {}};
  raster.values.assign(std::size_t(raster.columns) * raster.rows, std::numeric_limits<double>::quiet_NaN());
  for (const auto& [place, cell] : merged.cells) {
    const auto [row, column] = std::pair(place.first - frame.firstRow, place.second - frame.firstColumn);
    if (row >= 0 && row < frame.rows && column >= 0 && column < frame.columns)
      raster.at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)) = value(cell);
  }
  return raster;
}

}  // namespace cairn::rockfall
