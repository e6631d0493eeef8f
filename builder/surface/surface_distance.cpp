// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/nearest_triangle.h"

namespace cairn::builder {

SurfaceDistance::Nearest SurfaceDistance::closest(const Vec3d& query) const {
  const TriangleHierarchy::Place place = nearestTriangle(triangles_, query);
  const TrianglePacket& packet = triangles_.packet(place.packet);
  return {length(packet.nearest(place.lane, query).offset), packet.triangle[place.lane]};
}

double SurfaceDistance::distanceToTriangle(std::uint32_t triangle, const Vec3d& point) const {
  const TriangleHierarchy::Place place = triangles_.placeOf(triangle);
  return length(triangles_.packet(place.packet).nearest(place.lane, point).offset);
}

double distanceRoundingBound(const Bounds& bounds, const Vec3d& query) {
  // Let q be the query, m the largest coordinate vector of the mesh and u = 2^-53. To first order, the frame of a
  // triangle is orthonormal within 8 u. Its corners are reproduced within 12 u |edge|, and the offset from the corner
  // within 4 u |q - a|. The projection and the removal of the in-plane part add 24 u |q - a|. Squares, the comparison
  // of boxes (4 u of the distance) and the root add 8 u. With |edge| <= 2 |m| and |q - a| <= |q| + |m| the sum is below
  // 128 u (|q| + |m|). Twice that covers the higher orders.
  constexpr double kUnits = 256 * 0x1p-53;
  const auto largest = [](const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  const double mesh = std::max(largest(bounds.lower), largest(bounds.upper));
  return kUnits * std::numbers::sqrt3 * (largest(query) + mesh);
}

}  // namespace cairn::builder
