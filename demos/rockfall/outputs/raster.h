// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "rockfall/outputs/merged.h"
#include "rockfall/simulation/ground.h"
#include "rockfall/terrain/raster.h"

namespace cairn::rockfall {

/// The cells of a raster that cover the ground.
struct RasterFrame {
  double cellM = 1;
  std::int32_t firstColumn = 0, firstRow = 0;
  std::int32_t columns = 0, rows = 0;
};

/// Returns the cells that cover the ground. Precondition: the ground is in the map's coordinates.
RasterFrame rasterFrame(const Ground& ground, double cellM);

/// Returns `value` of the cells that some rock passed, NaN for the other cells.
Raster rasterOf(const RasterFrame& frame, const MergedRuns& merged,
                const std::function<double(const CellSummary&)>& value);

}  // namespace cairn::rockfall
