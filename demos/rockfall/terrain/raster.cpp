// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::rockfall {

namespace {
constexpr std::uint64_t kMaxPoints = 1ULL << 20, kMaxValues = 1ULL << 28;
// Cells from 0 to the raster: doubles keep thousandths of a cell.
constexpr double kMostCellsAway = 0x1p40;
}  // namespace

Status checkRasterSize(std::uint64_t columns, std::uint64_t rows) {
  if (columns >= 1 && rows >= 1 && columns <= kMaxPoints && rows <= kMaxPoints && columns * rows <= kMaxValues)
    return {};
  return Error{"has " + std::to_string(columns) + " x " + std::to_string(rows) +
               " values: give at least one, and at most 2^20 a side and 2^28 in all"};
}

Result<bullet::TerrainGrid> terrainGridOf(const Raster& raster) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const double height : raster.values) lowest = std::min(lowest, height);  // false for NaN, which stays out
  if (!std::isfinite(lowest)) return Error{"has no heights: a terrain needs some"};
  if (std::max(std::abs(raster.x), std::abs(raster.y)) > kMostCellsAway * raster.cell)
    return Error{fmt::format("lies at ({:g}, {:g}), too far from 0 for cells of {:g} m: move it nearer", raster.x,
                             raster.y, raster.cell)};
  bullet::TerrainGrid grid;
  grid.columns = raster.columns;
  grid.rows = raster.rows;
  grid.cell = raster.cell;
  grid.origin = {raster.x, raster.y, std::floor(lowest)};
  grid.heights.reserve(raster.values.size());
  for (const double height : raster.values) grid.heights.push_back(static_cast<float>(height - grid.origin.z));
  return grid;
}

Raster rasterOf(const bullet::TerrainGrid& grid) {
  Raster raster{grid.columns, grid.rows, grid.cell, grid.origin.x, grid.origin.y, {}, {}};
  raster.values.reserve(grid.heights.size());
  for (const float height : grid.heights) raster.values.push_back(grid.origin.z + double(height));
  return raster;
}

}  // namespace cairn::rockfall
