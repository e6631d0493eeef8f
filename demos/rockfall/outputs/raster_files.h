// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "rockfall/outputs/raster.h"

namespace cairn::rockfall {

/// The rasters of an ensemble as ESRI ASCII grids, by file name. None if the case asks for none.
std::vector<std::pair<std::string, std::string>> asciiRasters(const Case& description, const Ground& ground,
                                                              const MergedRuns& merged);

/// Writes what says more of the same rasters: GeoTIFFs on request, and a .prj beside each ESRI ASCII grid where the
/// projection is known. Both depend on GDAL's version, so the merged hash leaves them out.
Status writeGeoRasters(const std::filesystem::path& folder, const Case& description, const Ground& ground,
                       const MergedRuns& merged);

}  // namespace cairn::rockfall
