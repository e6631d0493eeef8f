// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/gis/map_reader.h"

namespace cairn::rockfall {

/// Reads the trees that are in maps: points with a diameter are stems, and the classes of polygons or cells become
/// stems drawn by the case's seed, the same for all runs. See `readMaps`.
Status readTrees(const MapReader& reader, Case& description);

}  // namespace cairn::rockfall
