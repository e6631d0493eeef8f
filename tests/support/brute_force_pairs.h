// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <LinearMath/btQuaternion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "distance_oracle.h"
#include "scenes/truth/exact_check.h"

namespace cairn::test {

inline scenes::Placement turned(const Vec3d& axis, double angle, const Vec3d& by) {
  const btQuaternion q(btVector3(btScalar(axis.x), btScalar(axis.y), btScalar(axis.z)), btScalar(angle));
  // In double: Bullet's single-precision matrix would not be orthonormal enough.
  const double n =
      std::sqrt(double(q.x()) * q.x() + double(q.y()) * q.y() + double(q.z()) * q.z() + double(q.w()) * q.w());
  const double x = q.x() / n, y = q.y() / n, z = q.z() / n, w = q.w() / n;
  return {Mat3d{{Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                 Vec3d{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                 Vec3d{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}},
          by};
}

/// Two meshes, each triangle of one against each of the other in extended precision: to hold the exact check against,
/// with which this shares no code or method. No tree, no boxes, no predicates. Both meshes closed and facing outward.
class BruteForcePair {
 public:
  using Wide = DistanceOracle::Wide;
  using Corners = std::array<Wide, 3>;

  BruteForcePair(const builder::TriangleMesh& a, const builder::TriangleMesh& b, const scenes::Placement& bFromA)
      : b_(b) {
    placedA_ = a;
    for (Vec3d& v : placedA_.vertices) v = bFromA * v;
    a_ = cornersOf(placedA_);
    inB_ = cornersOf(b_);
  }

  /// Whether an edge of either mesh passes through a triangle of the other.
  bool cross() const {
    return std::ranges::any_of(a_, [&](const Corners& a) {
      return std::ranges::any_of(inB_, [&](const Corners& b) { return edgesPierce(a, b) || edgesPierce(b, a); });
    });
  }

  /// Least distance, 0 where they cross.
  double separation() const {
    if (cross()) return 0;
    long double best = std::numeric_limits<long double>::infinity();
    for (const Corners& a : a_)
      for (const Corners& b : inB_) best = std::min(best, distanceOf(a, b));
    return static_cast<double>(best);
  }

  /// Distance from the other's surface of the vertex of either mesh that is deepest in the other's solid, by winding
  /// numbers; 0 if there is none.
  double deepestVertex() const {
    const auto deepest = [](const builder::TriangleMesh& points, const builder::TriangleMesh& solid) {
      const DistanceOracle oracle{solid};
      double best = 0;
      for (const Vec3d& p : points.vertices)
        if (oracle.windingNumber(p) > 0.5) best = std::max(best, oracle.distance(p));
      return best;
    };
    return std::max(deepest(placedA_, b_), deepest(b_, placedA_));
  }

 private:
  static std::vector<Corners> cornersOf(const builder::TriangleMesh& mesh) {
    std::vector<Corners> list;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto c = mesh.corners(t);
      list.push_back({Wide(c[0]), Wide(c[1]), Wide(c[2])});
    }
    return list;
  }

  static bool edgesPierce(const Corners& edges, const Corners& t) {
    return pierces(edges[0], edges[1], t) || pierces(edges[1], edges[2], t) || pierces(edges[2], edges[0], t);
  }

  /// Whether the segment from p to q passes through the triangle, by the signs of volumes.
  static bool pierces(const Wide& p, const Wide& q, const Corners& t) {
    const auto volume = [](const Wide& a, const Wide& b, const Wide& c, const Wide& d) {
      return dot(cairn::cross(b - a, c - a), d - a);
    };
    if ((volume(t[0], t[1], t[2], p) > 0) == (volume(t[0], t[1], t[2], q) > 0)) return false;
    const bool first = volume(p, q, t[0], t[1]) > 0;
    return (volume(p, q, t[1], t[2]) > 0) == first && (volume(p, q, t[2], t[0]) > 0) == first;
  }

  /// Of two triangles that do not cross: corner against triangle, edge against edge.
  static long double distanceOf(const Corners& a, const Corners& b) {
    long double best = std::numeric_limits<long double>::infinity();
    for (int k = 0; k < 3; ++k) {
      best = std::min({best, DistanceOracle::toTriangle(a[k], b[0], b[1], b[2]),
                       DistanceOracle::toTriangle(b[k], a[0], a[1], a[2])});
      for (int l = 0; l < 3; ++l) best = std::min(best, ofLines(a[k], a[(k + 1) % 3], b[l], b[(l + 1) % 3]));
    }
    return best;
  }

  /// Of two segments where they are nearest between their ends, else infinite: ends are asked about elsewhere.
  static long double ofLines(const Wide& a, const Wide& b, const Wide& c, const Wide& d) {
    const Wide u = b - a, v = d - c, w = c - a;
    const long double uu = lengthSq(u), vv = lengthSq(v), uv = dot(u, v), determinant = uu * vv - uv * uv;
    const long double s = (dot(u, w) * vv - dot(v, w) * uv), t = (dot(u, w) * uv - dot(v, w) * uu);
    const bool isBetween = s >= 0 && s <= determinant && t >= 0 && t <= determinant && determinant > 0;
    if (!isBetween) return std::numeric_limits<long double>::infinity();
    return length((a + u * (s / determinant)) - (c + v * (t / determinant)));
  }

  builder::TriangleMesh placedA_;
  const builder::TriangleMesh& b_;
  std::vector<Corners> a_, inB_;
};

}  // namespace cairn::test
