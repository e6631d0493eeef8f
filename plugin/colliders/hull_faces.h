// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btPolyhedralConvexShape.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernel/convex_body.h"

namespace cairn::bullet {

/// The triangles of a convex hull, in the shape's frame and world lengths, without its margin. Faces know their
/// normals, whereas GJK has no direction where two bodies touch.
///
///     if (const auto hull = HullFaces::of(shape)) nearest = hull->nearest(p);
///
/// Immutable. Source: `btConvexHullComputer`, which leaves out corners that stick out by less than a ten-thousandth of
/// the size.
class HullFaces {
 public:
  /// The faces of the shape, shared by all callers while any of them keeps the pointer. Null for flat shapes, and for
  /// those without corners of their own or with more than `tuning::kMaxHullVertices`. They are made on the first call,
  /// and again after the shape has changed.
  static std::shared_ptr<const HullFaces> of(const btPolyhedralConvexShape& shape);

  /// Whether the shape still has these corners.
  bool isOf(const btPolyhedralConvexShape& shape) const;
  /// The surface point nearest to `p`. Cost: linear in the faces, some microseconds.
  NearestPoint nearest(const Vec3& p) const;
  /// The greatest height above a face's plane; for a point outside, a lower bound on its distance.
  float heightAbove(const Vec3& p) const;

 private:
  struct Face {
    std::array<Vec3, 3> corner;
    Vec3 normal;
    float offset = 0;
  };

  explicit HullFaces(const btPolyhedralConvexShape& shape);

  std::vector<btVector3> corners_;  // all of the shape's
  std::vector<Face> faces_;
};

}  // namespace cairn::bullet
