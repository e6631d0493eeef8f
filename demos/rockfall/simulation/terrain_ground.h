// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "cairn/bullet/terrain_shape.h"
#include "rockfall/simulation/ground.h"

namespace cairn::rockfall {

/// A terrain with its zones of materials. All queries take constant time but for the zones whose boxes a point is in.
class TerrainGround final : public Ground {
 public:
  TerrainGround(std::unique_ptr<bullet::TerrainShape> shape, TerrainSection section, std::string projection);

  btCollisionShape& shape() override { return *shape_; }
  btTransform place() const override;
  bool covers(const MapPoint& point) const override;
  double heightAt(const MapPoint& point) const override;
  Vec3d normalAt(const MapPoint& point) const override;
  MaterialId materialAt(const MapPoint& point) const override { return section_.materialAt(point); }
  Vec3d lower() const override { return lower_; }
  Vec3d upper() const override { return upper_; }
  const std::string& projection() const override { return projection_; }

 private:
  /// In the shape's frame. On the edge, where its float coordinates may be a rounding short of the grid's, within it.
  MapPoint inShape(const MapPoint& point) const;

  std::unique_ptr<bullet::TerrainShape> shape_;
  TerrainSection section_;
  std::string projection_;
  Vec3d lower_, upper_;
};

}  // namespace cairn::rockfall
