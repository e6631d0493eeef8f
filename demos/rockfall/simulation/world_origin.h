// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/result.h"
#include "rockfall/case/case.h"
#include "rockfall/simulation/run_result.h"

namespace cairn::rockfall {

/// Returns the place of the world's origin on the map, so that Bullet's single precision resolves half a millimetre all
/// over the ground. It is the map's own origin if no coordinate reaches 10 km. Otherwise it is the middle of the
/// ground, on whole kilometres. Heights are those of the map. Fails, with the path in the case, for ground that is too
/// large or too high for this.
Result<MapPoint> worldOriginOf(const bullet::TerrainGrid& grid);

/// Converts the case from the map's coordinates to those of a world with its origin there. Contents of its files stay
/// unchanged.
void moveToWorld(Case& description, const MapPoint& origin);
/// Converts a run's records back to the map's coordinates. Cells count from the map's origin already.
void moveToMap(RunResult& result, const MapPoint& origin);

}  // namespace cairn::rockfall
