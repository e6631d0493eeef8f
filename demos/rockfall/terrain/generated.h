// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/result.h"
#include "rockfall/case/terrain_section.h"

namespace cairn::rockfall {

/// Generated terrain as a grid over the part of the map that the case asks for, rounded up to whole cells. Its middle
/// is a row of points at y = 0, so that of the even number of rows of cells the triangles are their own mirror image.
/// Heights are the formulas', rounded to float, and roughness: a pure function of parameters and seed, bit for bit.
/// Preconditions: parameters as `readTerrain` takes them. Fails, with the path in the case, for too many points.
/// Cost: linear in the points.
Result<bullet::TerrainGrid> generateTerrain(const PlaneTerrain& plane, std::uint64_t seed);
Result<bullet::TerrainGrid> generateTerrain(const SteppedSlopeTerrain& slope, std::uint64_t seed);
/// Both sides are equal to the bit, roughness included.
Result<bullet::TerrainGrid> generateTerrain(const ChannelTerrain& channel, std::uint64_t seed);
Result<bullet::TerrainGrid> generateTerrain(const TalusConeTerrain& cone, std::uint64_t seed);

}  // namespace cairn::rockfall
