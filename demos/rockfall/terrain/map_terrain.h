// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/result.h"
#include "rockfall/case/case.h"

namespace cairn::rockfall {

/// The terrain of a case, in the map's coordinates.
struct MapTerrain {
  bullet::TerrainGrid grid;
  std::string projection;  ///< of the raster it came from or the case's, as WKT; empty where it is not known
};

/// Generates the terrain of a case, or reads its raster or mesh. File names are relative to the case's folder. Fails in
/// one sentence with the path in the case and, for files, their names.
Result<MapTerrain> terrainOf(const Case& scene);

}  // namespace cairn::rockfall
