// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "rockfall/case/case.h"
#include "rockfall/rocks/rock_stock.h"
#include "rockfall/simulation/ground.h"

namespace cairn::rockfall {

/// A case with what all its runs share. In the world's coordinates, description and ground too.
struct Scene {
  Case description;
  MapPoint worldOrigin{};  ///< where the world's origin is on the map, see `worldOriginOf`
  std::unique_ptr<Ground> ground;
  RockStock stock;
  /// SHA-256, hexadecimal, over case, terrain and trees: runs of equal scenes and equal numbers are equal.
  std::string hash;
};

/// Fails as `terrainOf`, `worldOriginOf`, `makeGround` and `stockRocks` do, for a release box that reaches beyond the
/// ground and for rasters of more than 64 million cells or of a format that needs GDAL where it is not built in.
Result<Scene> prepareScene(Case description, TreeCache& cache, const builder::ProgressCallback& progress = {});

}  // namespace cairn::rockfall
