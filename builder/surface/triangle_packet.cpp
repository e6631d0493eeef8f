// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/triangle_packet.h"

#include <algorithm>

namespace cairn::builder {

void TrianglePacket::set(int lane, std::uint32_t index, const std::array<Vec3d, 3>& corners) {
  const auto& [a, b, c] = corners;
  const double ab = length(b - a);
  const Vec3d u = (b - a) / ab;
  const Vec3d toC = c - a;
  const double cx = dot(toC, u);
  const Vec3d up = toC - u * cx;
  const double cy = length(up);
  // Projects a second time. The first projection leaves a component along u of the order of rounding, which a sliver
  // would magnify.
  const Vec3d v = normalized(up - u * dot(up, u));

  triangle[lane] = index;
  originX[lane] = a.x, originY[lane] = a.y, originZ[lane] = a.z;
  uX[lane] = u.x, uY[lane] = u.y, uZ[lane] = u.z;
  vX[lane] = v.x, vY[lane] = v.y, vZ[lane] = v.z;
  lengthAB[lane] = ab;
  lengthAC[lane] = std::sqrt(cx * cx + cy * cy);
  acX[lane] = cx / lengthAC[lane], acY[lane] = cy / lengthAC[lane];
  lengthBC[lane] = std::sqrt((cx - ab) * (cx - ab) + cy * cy);
  bcX[lane] = (cx - ab) / lengthBC[lane], bcY[lane] = cy / lengthBC[lane];
}

namespace {

/// A nearest point within the plane, and its feature.
struct PlanePoint {
  double x = 0, y = 0;
  double distanceSq = 0;  // within the plane
  Feature feature = Feature::face;
};

struct Edge {
  double startX, directionX, directionY, length;  // every edge starts on the line AB
  Feature start, end, interior;
};

PlanePoint nearestOnEdge(double x, double y, const Edge& e) {
  const double along = (x - e.startX) * e.directionX + y * e.directionY;
  const double clamped = std::min(std::max(along, 0.0), e.length);
  PlanePoint r{e.startX + clamped * e.directionX, clamped * e.directionY};
  r.distanceSq = (x - r.x) * (x - r.x) + (y - r.y) * (y - r.y);
  r.feature = along <= 0 ? e.start : along >= e.length ? e.end : e.interior;
  return r;
}

}  // namespace

TrianglePacket::Nearest TrianglePacket::nearest(int lane, const Vec3d& query) const {
  const Vec3d p = query - Vec3d{originX[lane], originY[lane], originZ[lane]};
  const Vec3d u{uX[lane], uY[lane], uZ[lane]}, v{vX[lane], vY[lane], vZ[lane]};
  const double x = dot(p, u), y = dot(p, v);
  const bool inside = y >= 0 && acX[lane] * y <= acY[lane] * x && bcX[lane] * y >= bcY[lane] * (x - lengthAB[lane]);
  if (inside) return {p - u * x - v * y, Feature::face};
  PlanePoint best = nearestOnEdge(x, y, {0, 1, 0, lengthAB[lane], Feature::corner0, Feature::corner1, Feature::edge0});
  const PlanePoint others[] = {
      nearestOnEdge(
          x, y,
          {lengthAB[lane], bcX[lane], bcY[lane], lengthBC[lane], Feature::corner1, Feature::corner2, Feature::edge1}),
      nearestOnEdge(x, y,
                    {0, acX[lane], acY[lane], lengthAC[lane], Feature::corner0, Feature::corner2, Feature::edge2})};
  for (const PlanePoint& other : others) {
    if (other.distanceSq < best.distanceSq) best = other;
  }
  return {p - u * best.x - v * best.y, best.feature};
}

}  // namespace cairn::builder
