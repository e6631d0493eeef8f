// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "rockfall/outputs/merged.h"
#include "rockfall/simulation/ground.h"

namespace cairn::rockfall {

/// The cells of a raster that cover the ground.
struct RasterFrame {
  double cellM = 1;
  std::int32_t firstColumn = 0, firstRow = 0;
  std::int32_t columns = 0, rows = 0;
};

RasterFrame rasterFrame(const Ground& ground, double cellM);

/// An ESRI ASCII grid, north row first, -9999 where no rock has been. `value` of a cell that some rock passed.
std::string esriAscii(const RasterFrame& frame, const MergedRuns& merged,
                      const std::function<double(const CellSummary&)>& value);

}  // namespace cairn::rockfall
