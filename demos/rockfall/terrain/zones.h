// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/bullet/terrain_shape.h"

namespace cairn::rockfall {

/// Of what part of a terrain is made.
struct MaterialZone {
  std::uint16_t material = 0;                  ///< index of a material
  std::vector<std::array<double, 2>> polygon;  ///< corners in the map's coordinates, closed by itself; may cross itself
};

/// Whether a point is inside a polygon, by the even-odd rule. Of a border shared by two polygons every point belongs to
/// exactly one. Linear in the corners.
bool isInside(std::span<const std::array<double, 2>> polygon, double x, double y);

/// A material for each cell of the grid, row by row from the south: that of the last zone its middle is in, else
/// `base`. Cost: zones' corners times the cells in their boxes.
std::vector<std::uint16_t> materialsOfCells(const bullet::TerrainGrid& grid, std::uint16_t base,
                                            std::span<const MaterialZone> zones);

}  // namespace cairn::rockfall
