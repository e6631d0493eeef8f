// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/terrain_ground.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "scenes/bodies/model.h"

namespace cairn::rockfall {

TerrainGround::TerrainGround(std::unique_ptr<bullet::TerrainShape> shape, TerrainSection section,
                             std::string projection)
    : shape_(std::move(shape)), section_(std::move(section)), projection_(std::move(projection)) {
  const bullet::TerrainGrid& grid = shape_->grid();
  const double height = shape_->origin().z;
  lower_ = {grid.origin.x, grid.origin.y, height + double(shape_->lower().z())};
  upper_ = {grid.origin.x + grid.cell * (grid.columns - 1), grid.origin.y + grid.cell * (grid.rows - 1),
            height + double(shape_->upper().z())};
}

btTransform TerrainGround::place() const {
  return btTransform(btMatrix3x3::getIdentity(), scenes::toBullet(shape_->origin()));
}

MapPoint TerrainGround::inShape(const MapPoint& point) const {
  const auto within = [](btScalar low, double at, btScalar high) { return std::clamp(at, double(low), double(high)); };
  return {within(shape_->lower().x(), point[0] - shape_->origin().x, shape_->upper().x()),
          within(shape_->lower().y(), point[1] - shape_->origin().y, shape_->upper().y())};
}

bool TerrainGround::covers(const MapPoint& point) const {
  if (!(point[0] >= lower_.x && point[0] < upper_.x && point[1] >= lower_.y && point[1] < upper_.y)) return false;
  const auto [x, y] = inShape(point);
  return shape_->heightAt(x, y).has_value();
}

double TerrainGround::heightAt(const MapPoint& point) const {
  assert(covers(point));
  const auto [x, y] = inShape(point);
  return shape_->origin().z + *shape_->heightAt(x, y);
}

Vec3d TerrainGround::normalAt(const MapPoint& point) const {
  assert(covers(point));
  const auto [x, y] = inShape(point);
  return scenes::fromBullet(*shape_->normalAt(x, y));
}

Result<std::unique_ptr<Ground>> makeGround(MapTerrain terrain, const TerrainSection& section) {
  auto shape = bullet::TerrainShape::create(std::move(terrain.grid));
  if (!shape) return Error{"/terrain: " + shape.error().message};
  return std::unique_ptr<Ground>(
      std::make_unique<TerrainGround>(std::move(shape).value(), section, std::move(terrain.projection)));
}

Result<std::unique_ptr<Ground>> makeGround(const Case& scene) {
  auto terrain = terrainOf(scene);
  if (!terrain) return terrain.error();
  return makeGround(std::move(terrain).value(), scene.terrain);
}

}  // namespace cairn::rockfall
