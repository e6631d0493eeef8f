// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/raster.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace cairn::rockfall {

RasterFrame rasterFrame(const Ground& ground, double cellM) {
  const auto cellOf = [&](double coordinate) { return static_cast<std::int32_t>(std::floor(coordinate / cellM)); };
  RasterFrame frame{cellM, cellOf(ground.lower().x), cellOf(ground.lower().y), 0, 0};
  // Nothing that is over the ground is on its upper edge.
  frame.columns = static_cast<std::int32_t>(std::ceil(ground.upper().x / cellM)) - frame.firstColumn;
  frame.rows = static_cast<std::int32_t>(std::ceil(ground.upper().y / cellM)) - frame.firstRow;
  return frame;
}

std::string esriAscii(const RasterFrame& frame, const MergedRuns& merged,
                      const std::function<double(const CellSummary&)>& value) {
  std::string text =
      fmt::format("ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value -9999\n", frame.columns,
                  frame.rows, frame.firstColumn * frame.cellM, frame.firstRow * frame.cellM, frame.cellM);
  for (std::int32_t row = frame.rows - 1; row >= 0; --row)
    for (std::int32_t column = 0; column < frame.columns; ++column) {
      const auto cell = merged.cells.find({frame.firstRow + row, frame.firstColumn + column});
      if (cell == merged.cells.end())
        text += "-9999";
      else
        fmt::format_to(std::back_inserter(text), "{:.6g}", value(cell->second));
      text += column + 1 < frame.columns ? ' ' : '\n';
    }
  return text;
}

}  // namespace cairn::rockfall
