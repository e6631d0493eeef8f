// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/builder/triangle_mesh.h"
#include "surface/triangle_hierarchy.h"

namespace cairn::builder {

/// Unsigned distance to any triangles: open, self-intersecting or inconsistently oriented. `SignedDistance` is the
/// signed variant. Safe to query from many threads. Queries must be finite.
class SurfaceDistance {
 public:
  /// Precondition: at least one triangle, none degenerate. O(n log n).
  explicit SurfaceDistance(const TriangleMesh& surface) : bounds_(boundsOf(surface)), triangles_(surface) {}

  struct Nearest {
    double distance = 0;
    std::uint32_t triangle = 0;
  };
  Nearest closest(const Vec3d& query) const;

  /// Returns the distance to one triangle: a convex function of `point`, never less than `closest(point).distance`.
  /// Constant time.
  double distanceToTriangle(std::uint32_t triangle, const Vec3d& point) const;

  const Bounds& bounds() const { return bounds_; }

 private:
  Bounds bounds_;
  TriangleHierarchy triangles_;
};

/// Returns an upper bound of the rounding error of a `TriangleHierarchy` distance query to triangles within `bounds`.
double distanceRoundingBound(const Bounds& bounds, const Vec3d& query);

}  // namespace cairn::builder
