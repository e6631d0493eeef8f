// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/result.h"
#include "rockfall/case/terrain_section.h"

namespace cairn::rockfall {

/// Generates terrain as a grid over the part of the map that the case names, rounded up to whole cells. Its middle is a
/// row of points at y = 0, so the number of rows of cells is even and the triangles are mirror-symmetric. Heights are
/// the formulas' values rounded to float, plus roughness. They are a pure function of parameters and seed, bit for bit.
/// Preconditions: `readTerrain` accepted the parameters. Fails, with the path in the case, for too many points. Cost:
/// linear in the points.
Result<bullet::TerrainGrid> generateTerrain(const PlaneTerrain& plane, std::uint64_t seed);
Result<bullet::TerrainGrid> generateTerrain(const SteppedSlopeTerrain& slope, std::uint64_t seed);
/// Both sides are equal bit for bit, roughness included.
Result<bullet::TerrainGrid> generateTerrain(const ChannelTerrain& channel, std::uint64_t seed);
Result<bullet::TerrainGrid> generateTerrain(const TalusConeTerrain& cone, std::uint64_t seed);

}  // namespace cairn::rockfall
