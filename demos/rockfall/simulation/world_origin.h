// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/result.h"
#include "rockfall/case/case.h"
#include "rockfall/simulation/run_result.h"

namespace cairn::rockfall {

/// Where on the map the world's origin is to be, so that Bullet's single precision tells half a millimetre all over
/// the ground: at the map's own if no coordinate reaches 10 km, else in the middle of the ground, on whole kilometres.
/// Heights are those of the map. Fails for ground that is too large or too high for that, with the path in the case.
Result<MapPoint> worldOriginOf(const bullet::TerrainGrid& grid);

/// The case, in the map's coordinates before, in those of a world with its origin there. What its files hold stays as
/// it is.
void moveToWorld(Case& description, const MapPoint& origin);
/// The other way, for what a run writes down. Cells count from the map's origin already.
void moveToMap(RunResult& result, const MapPoint& origin);

}  // namespace cairn::rockfall
