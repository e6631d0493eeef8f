// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rockfall/terrain/raster.h"

namespace cairn::rockfall {

/// Reads an ESRI ASCII grid: `ncols`, `nrows`, `xllcorner` or `xllcenter`, `yllcorner` or `yllcenter`, `cellsize` (or
/// `dx` and `dy` that are equal) and maybe `NODATA_value` (-9999 where there is none), in this order and in any case,
/// then the values from north to south, wherever lines end. There is no value where NaN stands, and where a number
/// stands that is the same as `NODATA_value` in single precision. Fails with one sentence that names the file and the
/// line. Linear in the file.
Result<Raster> readAsciiGrid(const std::filesystem::path& path);
/// The same of a text; `name` is what errors call it.
Result<Raster> parseAsciiGrid(std::string_view text, const std::string& name);

/// Writes one, completely or not at all. Every number is the shortest that reads back as itself.
Status writeAsciiGrid(const std::filesystem::path& path, const Raster& raster);
std::string asciiGrid(const Raster& raster);

}  // namespace cairn::rockfall
