// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "rockfall/terrain/raster.h"

namespace cairn::rockfall {

/// True when this program was built with GDAL. Without it the functions below fail and say so.
bool hasGdal();

/// Reads the first band of any raster file that GDAL supports: north up or south up, square cells, coordinates in
/// metres. Fails with one sentence that names the file.
Result<Raster> readByGdal(const std::filesystem::path& path);

/// The meaning of a raster's values, for those who open its file.
struct BandText {
  std::string description, unit;  ///< "greatest kinetic energy", "J"; the unit empty where there is none
};

/// Writes a GeoTIFF, completely or not at all. It has floats where all values are exact floats, else doubles.
Status writeGeoTiff(const std::filesystem::path& path, const Raster& raster, const BandText& text = {});

/// Reads a raster from a file: `.asc` with our own reader and the projection of a `.prj` beside it, all other formats
/// with GDAL.
Result<Raster> readRaster(const std::filesystem::path& path);

}  // namespace cairn::rockfall
