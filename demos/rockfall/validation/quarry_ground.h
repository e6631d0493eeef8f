// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "rockfall/case/materials.h"
#include "rockfall/terrain/map_terrain.h"

namespace cairn::rockfall {

/// The quarry's ground, sampled every `cellM` from above, and which kind of ground lies where: the uppermost. Where
/// none lies there is none; `otherwise` is told as its material.
struct QuarryGround {
  MapTerrain terrain;
  TerrainSection section;
};

/// Reads the three zones' meshes. `materials` holds their names. Fails with the file, for a mesh without triangles and
/// for more values than a raster may have.
Result<QuarryGround> readQuarryGround(const std::filesystem::path& folder, double cellM, const Materials& materials);

}  // namespace cairn::rockfall
