// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "rockfall/case/case.h"
#include "rockfall/rocks/rock_stock.h"
#include "rockfall/simulation/ground.h"

namespace cairn::rockfall {

/// A case and the objects that all its runs share, in the world's coordinates, description and ground included.
struct Scene {
  Case description;
  MapPoint worldOrigin{};  ///< where the world's origin is on the map, see `worldOriginOf`
  std::unique_ptr<Ground> ground;
  RockStock stock;
  /// SHA-256, hexadecimal, over case, terrain and trees. Runs with the same number are equal in scenes with equal
  /// hashes.
  std::string hash;
};

/// Prepares a scene. Fails as `terrainOf`, `readMaps`, `worldOriginOf`, `makeGround` and `stockRocks` do. Also fails
/// for a release box beyond the ground and for rasters of more than 64 million cells. A raster format that needs GDAL
/// fails in a build without it.
Result<Scene> prepareScene(Case description, TreeCache& cache, const builder::ProgressCallback& progress = {});

/// The same on ground that is there already, in the map's coordinates, in place of the case's terrain, whose material,
/// grid and zones hold.
Result<Scene> prepareScene(Case description, MapTerrain terrain, TreeCache& cache,
                           const builder::ProgressCallback& progress = {});

}  // namespace cairn::rockfall
