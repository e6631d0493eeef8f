// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/vec3.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

struct Triangle {
  Vec3 a, b, c;

  /// Unit, by the right-hand rule; zero for a degenerate triangle.
  Vec3 normal() const { return unitVector(cross(b - a, c - a)); }
};

/// The triangle's unit normal; for a degenerate triangle, any direction perpendicular to it.
Vec3 anyNormalOf(const Triangle& t);

/// The corner that lies farthest along `direction`.
inline Vec3 supportOf(const Triangle& t, const Vec3& direction) {
  const float a = dot(direction, t.a), b = dot(direction, t.b), c = dot(direction, t.c);
  if (a >= b && a >= c) return t.a;
  return b >= c ? t.b : t.c;
}

struct TrianglePoint {
  Vec3 point;
  bool onFace = false;  ///< inside, not on the border
};

/// The point of the (possibly degenerate) triangle nearest to `p`: the projection if that is inside, else a border
/// point.
TrianglePoint nearestOnTriangle(const Triangle& triangle, const Vec3& p);

/// The nearest points of two triangles; any pair of points where the triangles cross. Degenerate triangles count as
/// segments or points.
struct NearestPoints {
  Vec3 onFirst, onSecond;
};
NearestPoints nearestOfTriangles(const Triangle& first, const Triangle& second);

}  // namespace cairn::bullet
