// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/result.h"

namespace cairn::rockfall {

/// Values at the points of a regular grid, in a map's coordinates: a terrain that was read, or what is written of runs.
struct Raster {
  std::uint32_t columns = 0, rows = 0;
  double cell = 1;      ///< metres
  double x = 0, y = 0;  ///< of the first value: where the middle of its cell is
  /// Row by row from the south (least y), each along x. NaN: no value.
  std::vector<double> values;
  std::string projection;  ///< of the coordinates, as WKT; empty where it is not known

  double& at(std::uint32_t column, std::uint32_t row) { return values[std::size_t(row) * columns + column]; }
  double at(std::uint32_t column, std::uint32_t row) const { return values[std::size_t(row) * columns + column]; }
};

/// Whether somebody may ask for so many values: at least one, at most 2^20 a side and 2^28 in all. The error is what
/// follows a name: "has 3 x 0 values: ...".
Status checkRasterSize(std::uint64_t columns, std::uint64_t rows);

/// The raster's points as those of a terrain. Heights are told over a whole metre near the lowest, so that float keeps
/// tenths of a millimetre on mountains. Fails for what `TerrainShape::create` would not take.
Result<bullet::TerrainGrid> terrainGridOf(const Raster& raster);

/// The other way; all heights are those of the grid, rounded as its floats are.
Raster rasterOf(const bullet::TerrainGrid& grid);

}  // namespace cairn::rockfall
