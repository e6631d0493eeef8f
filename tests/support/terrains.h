// SPDX-License-Identifier: Zlib
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <utility>

#include "cairn/bullet/terrain_shape.h"
#include "random_tree.h"

namespace cairn::test {

inline constexpr bullet::TerrainDiagonals kEveryDiagonals[] = {
    bullet::TerrainDiagonals::alternating, bullet::TerrainDiagonals::rising, bullet::TerrainDiagonals::falling};

struct TerrainSize {
  std::uint32_t columns = 2, rows = 2;
  double cell = 1;
};

inline bullet::TerrainGrid terrainGrid(const TerrainSize& size, const std::function<double(double, double)>& height) {
  bullet::TerrainGrid grid;
  grid.columns = size.columns;
  grid.rows = size.rows;
  grid.cell = size.cell;
  for (std::uint32_t row = 0; row < size.rows; ++row)
    for (std::uint32_t column = 0; column < size.columns; ++column)
      grid.heights.push_back(static_cast<float>(height(column * size.cell, row * size.cell)));
  return grid;
}

/// Hills of several cells with noise on them; of `holes` in a thousand points the height is missing.
inline bullet::TerrainGrid randomTerrain(std::mt19937_64& engine, const TerrainSize& size, unsigned holes = 0) {
  const double high = size.cell * uniform(engine, 0.5, 5), phase = uniform(engine, 0, 6);
  return terrainGrid(size, [&](double x, double y) {
    if (engine() % 1000 < holes) return std::numeric_limits<double>::quiet_NaN();
    const double u = x / (5 * size.cell), v = y / (7 * size.cell);
    return high * (std::sin(u + phase) + std::cos(v)) + size.cell * uniform(engine, -0.2, 0.2);
  });
}

inline std::shared_ptr<bullet::TerrainShape> terrainOf(bullet::TerrainGrid grid) {
  auto shape = bullet::TerrainShape::create(std::move(grid));
  if (!shape) throw std::runtime_error(shape.error().message);
  return std::move(shape).value();
}

inline std::shared_ptr<bullet::TerrainShape> flatTerrain(bullet::TerrainDiagonals diagonals, const TerrainSize& size) {
  bullet::TerrainGrid grid = terrainGrid(size, [](double, double) { return 0; });
  grid.diagonals = diagonals;
  return terrainOf(std::move(grid));
}

}  // namespace cairn::test
