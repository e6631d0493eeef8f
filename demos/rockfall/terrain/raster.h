// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/result.h"

namespace cairn::rockfall {

/// Values at the points of a regular grid, in a map's coordinates: a terrain from a file, or an output of runs.
struct Raster {
  std::uint32_t columns = 0, rows = 0;
  double cell = 1;      ///< metres
  double x = 0, y = 0;  ///< of the first value: the middle of its cell
  /// Row by row from the south (least y), each along x. NaN: no value.
  std::vector<double> values;
  std::string projection;  ///< of the coordinates, as WKT; empty where it is not known

  double& at(std::uint32_t column, std::uint32_t row) { return values[std::size_t(row) * columns + column]; }
  double at(std::uint32_t column, std::uint32_t row) const { return values[std::size_t(row) * columns + column]; }
};

/// Checks the number of values: at least one, at most 2^20 a side and 2^28 in all. The error text continues a name:
/// "has 3 x 0 values: ...".
Status checkRasterSize(std::uint64_t columns, std::uint64_t rows);

/// Converts the raster's points to a terrain's. Heights are relative to a whole metre near the lowest, so that float
/// keeps tenths of a millimetre on mountains. Fails when `TerrainShape::create` would refuse the grid, and when it lies
/// more than 2^40 cells from 0.
Result<bullet::TerrainGrid> terrainGridOf(const Raster& raster);

/// Converts a terrain's grid to a raster; heights are rounded as the grid's floats are.
Raster rasterOf(const bullet::TerrainGrid& grid);

}  // namespace cairn::rockfall
