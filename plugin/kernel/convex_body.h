// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// The surface point of a convex shape that is nearest to a given one; frame and unit of the question.
struct NearestPoint {
  Vec3 point;
  Vec3 normal;         ///< unit, outwards; the shape lies behind the plane through `point`
  float distance = 0;  ///< negative inside
};

/// What the kernel asks of a convex body that has no mesh. Pair frame, world lengths, the shape's margin included.
class ConvexBody {
 public:
  virtual ~ConvexBody() = default;

  virtual NearestPoint nearest(const Vec3& point) = 0;
  /// It is no nearer to the point than that, if it does not hold it. Cheap.
  virtual float apartFrom(const Vec3& point) = 0;
  /// Its point that lies farthest along a direction: unit.
  virtual Vec3 support(const Vec3& direction) const = 0;
  /// A point inside of it.
  virtual Vec3 middle() const = 0;
};

}  // namespace cairn::bullet
