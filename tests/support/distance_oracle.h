// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::test {

/// Slow and simple answers in extended precision, to hold the fast ones against. They share no code or method with
/// them: the distance clamps to edges and projects to the plane, the sign is a winding number.
struct DistanceOracle {
  using Wide = BasicVec3<long double>;

  const builder::TriangleMesh& mesh;

  static long double toSegment(const Wide& p, const Wide& a, const Wide& b) {
    const Wide ab = b - a;
    const long double t = std::clamp(dot(p - a, ab) / lengthSq(ab), 0.0L, 1.0L);
    return length(p - (a + ab * t));
  }

  static long double toTriangle(const Wide& p, const Wide& a, const Wide& b, const Wide& c) {
    const Wide n = cross(b - a, c - a);
    const bool above =
        dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0;
    if (above) return std::abs(dot(p - a, n)) / length(n);
    return std::min({toSegment(p, a, b), toSegment(p, b, c), toSegment(p, c, a)});
  }

  double distance(const Vec3d& query) const {
    long double best = std::numeric_limits<long double>::infinity();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto c = mesh.corners(t);
      best = std::min(best, toTriangle(Wide(query), Wide(c[0]), Wide(c[1]), Wide(c[2])));
    }
    return static_cast<double>(best);
  }

  /// Sum of solid angles over 4 pi: 1 inside, 0 outside. Meaningless on the surface.
  double windingNumber(const Vec3d& query) const {
    double angle = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto c = mesh.corners(t);
      const Vec3d a = c[0] - query, b = c[1] - query, d = c[2] - query;
      const double la = length(a), lb = length(b), ld = length(d);
      angle += 2 * std::atan2(dot(a, cross(b, d)), la * lb * ld + dot(a, b) * ld + dot(b, d) * la + dot(d, a) * lb);
    }
    return angle / (4 * std::numbers::pi);
  }

  double depth(const Vec3d& query) const {
    const double d = distance(query);
    return windingNumber(query) > 0.5 ? d : -d;
  }
};

}  // namespace cairn::test
