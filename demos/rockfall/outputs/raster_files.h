// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rockfall/outputs/raster.h"

namespace cairn::rockfall {

/// A raster of an ensemble: its name without an extension, what it says, and the value of a cell that some rock passed.
struct RasterKind {
  std::string name, description, unit;
  std::function<double(const CellSummary&)> value;
};

/// All rasters, none if the case asks for none. `merged` must outlive them.
std::vector<RasterKind> rasterKinds(const Case& description, const MergedRuns& merged);

/// One of them as an ESRI ASCII grid. Precondition: the case asks for rasters.
std::string asciiRaster(const RasterKind& kind, const Case& description, const Ground& ground,
                        const MergedRuns& merged);

/// Writes what says more of the same rasters: GeoTIFFs on request, and a .prj beside each ESRI ASCII grid where the
/// projection is known. Both depend on GDAL's version, so the merged hash leaves them out.
Status writeGeoRasters(const std::filesystem::path& folder, const Case& description, const Ground& ground,
                       const MergedRuns& merged);

}  // namespace cairn::rockfall
