// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <vector>

#include "cairn/core/obstacle_traversal.h"
#include "placement/triangle.h"

namespace cairn::bullet {

/// The triangles of a concave shape near a tree, gathered once for a traversal and ordered by (part, index) and
/// corners, so that neither the shape's own order nor its acceleration structure shows in the result. Buffers are
/// reused.
class TriangleSoup {
 public:
  struct Source {
    int part = 0, index = 0;
    btVector3 corners[3];  // the shape's frame
  };

  /// Asks the shape for all triangles near the box [lower, upper] of its own frame.
  void gather(const btConcaveShape& shape, const btVector3& lower, const btVector3& upper);
  /// Whether the last gathering saw all of the box.
  bool covers(const btVector3& lower, const btVector3& upper) const;

  const std::vector<Source>& triangles() const { return triangles_; }
  /// Position in `triangles()` of the triangle with this part and index, or -1. Where a shape gives several the same
  /// numbers, that with the same corners.
  int find(const Source& wanted) const;

 private:
  std::vector<Source> triangles_;
  btVector3 lower_{1, 1, 1}, upper_{-1, -1, -1};
};

/// Triangles in the frame and unit of a tree, one element each.
class SoupObstacle final : public Obstacle {
 public:
  void clear(float margin);
  void add(const Triangle& triangle);

  std::uint32_t elementCount() const override { return static_cast<std::uint32_t>(elements_.size()); }
  std::uint32_t touches(const Family& family, std::uint32_t familySize, std::uint32_t element) const override;

 private:
  struct Element {
    Triangle triangle;
    Vec3 normal;
    float offset;
  };
  std::vector<Element> elements_;
  float margin_ = 0;
};

}  // namespace cairn::bullet
