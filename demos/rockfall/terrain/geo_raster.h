// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "rockfall/terrain/raster.h"

namespace cairn::rockfall {

/// True when this program was built with GDAL. Without it the functions below fail and say so.
bool hasGdal();

/// Reads the first band of any raster file that GDAL supports: north up or south up, square cells, coordinates in
/// metres. Fails with one sentence that names the file.
Result<Raster> readByGdal(const std::filesystem::path& path);

/// Writes a GeoTIFF, completely or not at all. It has floats where all values are exact floats, else doubles.
Status writeGeoTiff(const std::filesystem::path& path, const Raster& raster);

/// Reads a terrain from a file: `.asc` with our own reader, all other formats with GDAL.
Result<Raster> readRaster(const std::filesystem::path& path);

}  // namespace cairn::rockfall
