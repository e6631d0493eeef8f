// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <memory>
#include <vector>

#include "rockfall/simulation/ground.h"
#include "rockfall/simulation/height_grid.h"

namespace cairn::rockfall {

/// A height grid as Bullet's triangle mesh. Precondition: at least two rows and columns.
class GridGround final : public Ground {
 public:
  GridGround(HeightGrid grid, TerrainSection terrain);

  btCollisionShape& shape() override { return *shape_; }
  btTransform place() const override { return btTransform::getIdentity(); }
  bool covers(const MapPoint& point) const override;
  double heightAt(const MapPoint& point) const override;
  Vec3d normalAt(const MapPoint& point) const override;
  MaterialId materialAt(const MapPoint& point) const override { return terrain_.materialAt(point); }
  Vec3d lower() const override { return lower_; }
  Vec3d upper() const override { return upper_; }

 private:
  /// The triangle over a point: height where it is, and how it rises along x and y.
  struct Facet {
    double height, alongX, alongY;
  };
  Facet facetAt(const MapPoint& point) const;

  HeightGrid grid_;
  TerrainSection terrain_;
  Vec3d lower_, upper_;
  std::vector<btScalar> coordinates_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> mesh_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

}  // namespace cairn::rockfall
