// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/result.h"

namespace cairn::rockfall {

/// What all generated terrains share. Lengths in metres, angles in degrees; downhill is along +x from x = 0, the middle
/// at y = 0, z up. Numbers of cells are rounded to whole ones, across to an even number. The same parameters give the
/// same bits.
struct GeneratedGround {
  double cell = 1;
  double roughness = 0;  ///< greatest displacement of a grid point, up or down
  std::uint64_t seed = 1;
};

/// Evenly down to height 0.
struct PlaneTerrain {
  GeneratedGround ground{};
  double length = 100, width = 50;
  double degrees = 30;
};
Result<bullet::TerrainGrid> makePlane(const PlaneTerrain& terrain);

/// A level shelf, then benches with risers between them, then a level basin at height 0.
struct SteppedSlope {
  GeneratedGround ground{};
  double length = 1000, width = 200;  ///< of the slope, from shelf to basin
  double degrees = 35;                ///< from its top to its foot
  std::uint32_t benches = 8;
  double benchDegrees = 5;     ///< of a bench
  double benchFraction = 0.4;  ///< of the slope's length
  double shelf = 20, basin = 100;
};
Result<bullet::TerrainGrid> makeSteppedSlope(const SteppedSlope& terrain);

/// A valley that goes down along x, its banks hyperbolas. Heights are exactly the same on both sides, roughness
/// included, and so are the triangles: the diagonals alternate over an even number of rows of cells.
struct ChannelTerrain {
  GeneratedGround ground{};
  double length = 300, width = 100;
  double degrees = 20;      ///< of its bottom, downhill
  double bankDegrees = 35;  ///< what the banks come to
  double bottom = 10;       ///< width within which they bend up
};
Result<bullet::TerrainGrid> makeChannel(const ChannelTerrain& terrain);

/// The half x >= 0 of a cone with its tip at x = y = 0, on level ground at height 0 that goes on for `basin`.
struct TalusCone {
  GeneratedGround ground{};
  double radius = 100;
  double degrees = 34;
  double basin = 50;
};
Result<bullet::TerrainGrid> makeTalusCone(const TalusCone& terrain);

}  // namespace cairn::rockfall
