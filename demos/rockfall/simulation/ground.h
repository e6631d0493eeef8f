// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <LinearMath/btTransform.h>

#include <memory>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"
#include "rockfall/case/case.h"

namespace cairn::rockfall {

/// The ground of a scene: one height over each point of the map it covers. World frame, metres.
class Ground {
 public:
  virtual ~Ground() = default;

  virtual btCollisionShape& shape() = 0;
  /// Where the shape's body stands.
  virtual btTransform place() const = 0;

  virtual bool covers(const MapPoint& point) const = 0;
  /// Of the surface that bodies collide with. Precondition: `covers(point)`.
  virtual double heightAt(const MapPoint& point) const = 0;
  /// Upward, of unit length. Precondition: `covers(point)`.
  virtual Vec3d normalAt(const MapPoint& point) const = 0;
  virtual MaterialId materialAt(const MapPoint& point) const = 0;
  /// Corners of the box around the surface.
  virtual Vec3d lower() const = 0;
  virtual Vec3d upper() const = 0;
};

/// Fails for terrain that cannot be had: too many grid points, a source this build cannot read.
Result<std::unique_ptr<Ground>> makeGround(const Case& scene);

}  // namespace cairn::rockfall
