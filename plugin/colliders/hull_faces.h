// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btPolyhedralConvexShape.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernel/convex_body.h"

namespace cairn::bullet {

/// The triangles of a convex hull, in the shape's frame and world lengths, without its margin. Where GJK looks at the
/// way between two bodies, which is no way at all where they touch, faces have their normals. Source:
/// `btConvexHullComputer`, which leaves out corners that stick out by less than a ten-thousandth of the size.
/// Immutable.
class HullFaces {
 public:
  /// Those of the shape, shared by all who ask while anyone has them; null for what is flat, has no corners of its own
  /// or more than `tuning::kMaxHullVertices`. They are made when they are first asked for, or when the shape has
  /// changed.
  static std::shared_ptr<const HullFaces> of(const btPolyhedralConvexShape& shape);

  /// Whether the shape still has these corners.
  bool isOf(const btPolyhedralConvexShape& shape) const;
  /// Microseconds: in proportion to the faces.
  NearestPoint nearest(const Vec3& p) const;
  /// The greatest height above a face's plane: outside no more than the distance.
  float heightAbove(const Vec3& p) const;

 private:
  struct Face {
    std::array<Vec3, 3> corner;
    Vec3 normal;
    float offset = 0;
  };

  explicit HullFaces(const btPolyhedralConvexShape& shape);

  std::vector<btVector3> corners_;  // all the shape's
  std::vector<Face> faces_;
};

}  // namespace cairn::bullet
