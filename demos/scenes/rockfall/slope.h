// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::scenes {

/// A rough stepped slope as a triangle mesh: a shelf at the top, benches and risers, and a flat catch basin at the
/// foot. Banks on all sides keep rocks inside. Metres, z up, downhill along +x, the middle of the slope at y = 0.
class Slope {
 public:
  /// The same seed gives the same bits.
  explicit Slope(std::uint64_t seed);
  Slope(const Slope&) = delete;
  Slope& operator=(const Slope&) = delete;

  btBvhTriangleMeshShape& shape() { return *shape_; }

  /// Returns the height of the triangle mesh at (x, y). Precondition: `covers(x, y)`.
  double heightAt(double x, double y) const;
  bool covers(double x, double y) const;
  /// Returns the distance of a point from the triangle mesh, negative below it. Precondition: `covers(p.x, p.y)`.
  double signedDistance(const Vec3d& p) const;
  /// Returns the corners of the mesh in a box.
  std::vector<Vec3d> cornersIn(const Vec3d& lower, const Vec3d& upper) const;

  static constexpr double kShelfLength = 8;  ///< of the top shelf, from x = 0
  static constexpr double kHalfWidth = 8;    ///< of the part between the banks
  static constexpr double kShelfHeight = 24;

 private:
  double gridHeight(std::uint32_t column, std::uint32_t row) const;
  Vec3d corner(std::uint32_t column, std::uint32_t row) const;

  std::vector<double> heights_;  // of the grid points, row by row
  std::vector<btScalar> coordinates_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> mesh_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

}  // namespace cairn::scenes
