// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <vector>

#include "cairn/core/obstacle_traversal.h"
#include "placement/triangle.h"

namespace cairn::bullet {

/// The triangles of a concave shape near a tree, gathered once for a traversal. They are sorted by (part, index) and
/// corners, so that the result does not depend on the shape's own order or acceleration structure. Buffers are reused.
///
///     soup.gather(shape, lower, upper);
///     for (const TriangleSoup::Source& source : soup.triangles()) ...;
class TriangleSoup {
 public:
  struct Source {
    int part = 0, index = 0;
    btVector3 corners[3];  // the shape's frame
  };

  /// Gathers all triangles of the shape near the box [lower, upper] of its own frame.
  void gather(const btConcaveShape& shape, const btVector3& lower, const btVector3& upper);
  /// Whether the last call of `gather` covered all of this box.
  bool covers(const btVector3& lower, const btVector3& upper) const;

  const std::vector<Source>& triangles() const { return triangles_; }
  /// Index in `triangles()` of the triangle with this part and index, or -1. If a shape gives several triangles the
  /// same numbers, the corners decide.
  int find(const Source& wanted) const;

 private:
  std::vector<Source> triangles_;
  btVector3 lower_{1, 1, 1}, upper_{-1, -1, -1};
};

/// Triangles as the traversal of a tree tests them, in its frame and unit: one element each.
class SoupObstacle final : public Obstacle {
 public:
  /// Removes all triangles. `margin` (the tree's unit) is added to every sphere in tests.
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
