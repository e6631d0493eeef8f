// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "rockfall/terrain/raster.h"

namespace cairn::rockfall {

/// Whether this program was built with GDAL; without it the functions below fail and say so.
bool hasGdal();

/// The first band of any raster file GDAL knows: north up or south up, square cells, coordinates in metres. Fails with
/// one sentence that names the file.
Result<Raster> readByGdal(const std::filesystem::path& path);

/// Writes a GeoTIFF, completely or not at all: of floats where all values are such, else of doubles.
Status writeGeoTiff(const std::filesystem::path& path, const Raster& raster);

/// A terrain from a file: `.asc` by our own reader, everything else by GDAL.
Result<Raster> readRaster(const std::filesystem::path& path);

}  // namespace cairn::rockfall
