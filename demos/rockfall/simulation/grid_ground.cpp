// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/grid_ground.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace cairn::rockfall {

GridGround::GridGround(HeightGrid grid, TerrainSection terrain) : grid_(std::move(grid)), terrain_(std::move(terrain)) {
  assert(grid_.columns > 1 && grid_.rows > 1);
  for (std::uint32_t row = 0; row < grid_.rows; ++row)
    for (std::uint32_t column = 0; column < grid_.columns; ++column)
      for (const double c :
           {grid_.origin[0] + grid_.cell * column, grid_.origin[1] + grid_.cell * row, grid_.at(column, row)})
        coordinates_.push_back(static_cast<btScalar>(c));
  const auto point = [&](std::uint32_t column, std::uint32_t row) {
    return static_cast<int>(row * grid_.columns + column);
  };
  for (std::uint32_t row = 0; row + 1 < grid_.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < grid_.columns; ++column) {
      const int a = point(column, row), b = point(column + 1, row), c = point(column + 1, row + 1),
                d = point(column, row + 1);
      indices_.insert(indices_.end(), {a, b, c, a, c, d});
    }
  mesh_ = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(indices_.size() / 3), indices_.data(), static_cast<int>(3 * sizeof(int)),
      static_cast<int>(grid_.heights.size()), coordinates_.data(), static_cast<int>(3 * sizeof(btScalar)));
  shape_ = std::make_unique<btBvhTriangleMeshShape>(mesh_.get(), true);
  const auto [least, greatest] = std::ranges::minmax(grid_.heights);
  lower_ = {grid_.origin[0], grid_.origin[1], least};
  upper_ = {grid_.origin[0] + grid_.cell * (grid_.columns - 1), grid_.origin[1] + grid_.cell * (grid_.rows - 1),
            greatest};
}

bool GridGround::covers(const MapPoint& point) const {
  return point[0] >= lower_.x && point[0] < upper_.x && point[1] >= lower_.y && point[1] < upper_.y;
}

GridGround::Facet GridGround::facetAt(const MapPoint& point) const {
  assert(covers(point));
  const double column = (point[0] - grid_.origin[0]) / grid_.cell, row = (point[1] - grid_.origin[1]) / grid_.cell;
  const auto i = std::min(static_cast<std::uint32_t>(column), grid_.columns - 2);
  const auto j = std::min(static_cast<std::uint32_t>(row), grid_.rows - 2);
  const double u = column - i, v = row - j;
  const double origin = grid_.at(i, j), opposite = grid_.at(i + 1, j + 1);
  const double side = u >= v ? grid_.at(i + 1, j) : grid_.at(i, j + 1);
  const double alongX = u >= v ? side - origin : opposite - side, alongY = u >= v ? opposite - side : side - origin;
  return {origin + u * alongX + v * alongY, alongX / grid_.cell, alongY / grid_.cell};
}

double GridGround::heightAt(const MapPoint& point) const {
  return facetAt(point).height;
}

Vec3d GridGround::normalAt(const MapPoint& point) const {
  const Facet facet = facetAt(point);
  return normalized(Vec3d(-facet.alongX, -facet.alongY, 1));
}

Result<std::unique_ptr<Ground>> makeGround(const Case& scene) {
  const auto& source = scene.terrain.source;
  if (std::holds_alternative<RasterTerrain>(source) || std::holds_alternative<MeshTerrain>(source))
    return Error{"/terrain: terrain from a raster or a mesh cannot be run by this version: use a generated one"};
  auto grid = generateHeights(scene.terrain, scene.seed);
  if (!grid) return grid.error();
  return std::unique_ptr<Ground>(std::make_unique<GridGround>(std::move(grid).value(), scene.terrain));
}

}  // namespace cairn::rockfall
