// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "cairn/bullet/terrain_shape.h"
#include "rockfall/simulation/ground.h"

namespace cairn::rockfall {

/// A terrain with its zones of materials. All queries take constant time, except for the zones whose boxes contain the
/// point.
class TerrainGround final : public Ground {
 public:
  TerrainGround(std::unique_ptr<bullet::TerrainShape> shape, TerrainSection section, std::string projection);

  btCollisionShape& shape() override { return *shape_; }
  btTransform place() const override;
  bool covers(const MapPoint& point) const override;
  double heightAt(const MapPoint& point) const override;
  Vec3d normalAt(const MapPoint& point) const override;
  MaterialId materialAt(const MapPoint& point) const override { return section_.materialAt(point); }
  double cellM() const override { return shape_->grid().cell; }
  Vec3d lower() const override { return lower_; }
  Vec3d upper() const override { return upper_; }
  const std::string& projection() const override { return projection_; }

 private:
  /// Converts a point to the shape's frame. Points on the edge are moved inside, because the shape's float coordinates
  /// may be smaller than the grid's by a rounding.
  MapPoint inShape(const MapPoint& point) const;

  std::unique_ptr<bullet::TerrainShape> shape_;
  TerrainSection section_;
  std::string projection_;
  Vec3d lower_, upper_;
};

}  // namespace cairn::rockfall
