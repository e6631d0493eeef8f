// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/zones.h"

#include <algorithm>
#include <cmath>

namespace cairn::rockfall {

bool isInside(std::span<const std::array<double, 2>> polygon, double x, double y) {
  bool isIn = false;
  for (std::size_t i = 0, last = polygon.size() - 1; i < polygon.size(); last = i++) {
    // From the lower to the upper corner, so that both neighbours of a border round alike.
    const auto& [a, b] =
        std::minmax(polygon[last], polygon[i], [](const auto& p, const auto& q) { return p[1] < q[1]; });
    if (a[1] <= y && y < b[1] && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) isIn = !isIn;
  }
  return isIn;
}

namespace {

struct Span {
  std::uint32_t first, end;
};

// Cells whose middle may be within [low, high], of `count` cells from `origin` on.
Span cellsWithin(double low, double high, double origin, double cell, std::uint32_t count) {
  const auto place = [&](double at) {
    return static_cast<std::uint32_t>(std::clamp(std::floor((at - origin) / cell), 0.0, double(count)));
  };
  return {place(low - cell), place(high + cell)};
}

}  // namespace

std::vector<std::uint16_t> materialsOfCells(const bullet::TerrainGrid& grid, std::uint16_t base,
                                            std::span<const MaterialZone> zones) {
  const std::uint32_t columns = grid.columns - 1, rows = grid.rows - 1;
  std::vector<std::uint16_t> materials(std::size_t(columns) * rows, base);
  for (const MaterialZone& zone : zones) {
    if (zone.polygon.empty()) continue;
    const auto [lowX, highX] = std::ranges::minmax(zone.polygon, {}, [](const auto& p) { return p[0]; });
    const auto [lowY, highY] = std::ranges::minmax(zone.polygon, {}, [](const auto& p) { return p[1]; });
    const Span across = cellsWithin(lowX[0], highX[0], grid.origin.x, grid.cell, columns);
    const Span along = cellsWithin(lowY[1], highY[1], grid.origin.y, grid.cell, rows);
    for (std::uint32_t row = along.first; row < along.end; ++row)
      for (std::uint32_t column = across.first; column < across.end; ++column)
        if (isInside(zone.polygon, grid.origin.x + (column + 0.5) * grid.cell, grid.origin.y + (row + 0.5) * grid.cell))
          materials[std::size_t(row) * columns + column] = zone.material;
  }
  return materials;
}

}  // namespace cairn::rockfall
