// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <LinearMath/btTransform.h>

#include <memory>
#include <string>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"
#include "rockfall/case/case.h"
#include "rockfall/terrain/map_terrain.h"

namespace cairn::rockfall {

/// The ground of a scene: one height over each point it covers. All coordinates are in the frame of the terrain and the
/// zones it was made of, metres: a scene's ground in the world's, that of a case in the map's.
class Ground {
 public:
  virtual ~Ground() = default;

  virtual btCollisionShape& shape() = 0;
  /// Where the shape's body stands. To be used of a scene's ground only: the map's coordinates may be too large.
  virtual btTransform place() const = 0;

  /// Over the ground or one of its holes.
  bool isWithin(const MapPoint& point) const {
    return point[0] >= lower().x && point[0] < upper().x && point[1] >= lower().y && point[1] < upper().y;
  }
  /// Not over holes of a raster.
  virtual bool covers(const MapPoint& point) const = 0;
  /// Of the surface that bodies collide with. Precondition: `covers(point)`.
  virtual double heightAt(const MapPoint& point) const = 0;
  /// Upward, of unit length. Precondition: `covers(point)`.
  virtual Vec3d normalAt(const MapPoint& point) const = 0;
  virtual MaterialId materialAt(const MapPoint& point) const = 0;
  /// Between the points of its grid, along x and y.
  virtual double cellM() const = 0;
  /// Corners of the box around the surface.
  virtual Vec3d lower() const = 0;
  virtual Vec3d upper() const = 0;
  /// Of the map, as WKT; empty where it is not known.
  virtual const std::string& projection() const = 0;
};

/// Fails as `TerrainShape::create` does, with the path in the case.
Result<std::unique_ptr<Ground>> makeGround(MapTerrain terrain, const TerrainSection& section);
/// The ground of a case, in the map's coordinates. Fails as `terrainOf` does too.
Result<std::unique_ptr<Ground>> makeGround(const Case& scene);

}  // namespace cairn::rockfall
