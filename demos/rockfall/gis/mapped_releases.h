// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/gis/map_reader.h"

namespace cairn::rockfall {

/// Reads the places of release that are in maps: of points each the same, of lines by length, of polygons by size, of
/// a raster all cells that are neither zero nor without a value. See `readMaps`.
Status readReleases(const MapReader& reader, Case& description);

}  // namespace cairn::rockfall
