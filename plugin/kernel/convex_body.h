// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// The surface point of a convex shape that is nearest to a query point; in the frame and unit of the query.
struct NearestPoint {
  Vec3 point;
  Vec3 normal;         ///< unit, outwards; the shape lies behind the plane through `point`
  float distance = 0;  ///< from the query point, negative inside
};

/// A convex body without a mesh, as the kernel queries it. Pair frame, world lengths, the shape's margin included.
class ConvexBody {
 public:
  virtual ~ConvexBody() = default;

  /// The surface point nearest to `point`.
  virtual NearestPoint nearest(const Vec3& point) = 0;
  /// Lower bound on the distance from a point outside; anything for a point inside. Cheap.
  virtual float apartFrom(const Vec3& point) = 0;
  /// The point that lies farthest along a unit direction.
  virtual Vec3 support(const Vec3& direction) const = 0;
  /// A point inside the body.
  virtual Vec3 middle() const = 0;
};

}  // namespace cairn::bullet
