// SPDX-License-Identifier: Zlib
#include "terrain/terrain_balls.h"

#include "placement/triangle.h"

namespace cairn::bullet {

namespace {

bool isNear(const TerrainLattice::Corners& t, const Vec3d& center, float radius) {
  const auto fromCenter = [&](int i) { return Vec3(toVec3d(t.at[i]) - center); };
  const Triangle triangle{fromCenter(0), fromCenter(1), fromCenter(2)};
  return lengthSq(nearestOnTriangle(triangle, Vec3()).point) <= radius * radius;
}

}  // namespace

// Ground with slopes up to `steepest` is at least as far from a point as the point's height divided by the root of 1 +
// steepest^2.
GroundBelow groundBelow(const TerrainLattice& lattice, const Vec3d& point, double radius) {
  GroundBelow ground;
  ground.height = point.z - lattice.heightOver(point.x, point.y);
  const auto isWithin = [&](std::span<const btScalar> points, double at) {
    return at - radius >= double(points.front()) && at + radius <= double(points.back());
  };
  if (!isWithin(lattice.xs(), point.x) || !isWithin(lattice.ys(), point.y)) return ground;
  const auto steepest =
      double(lattice.steepest(lattice.columnsTouching(btScalar(point.x - radius), btScalar(point.x + radius)),
                              lattice.rowsTouching(btScalar(point.y - radius), btScalar(point.y + radius))));
  ground.factor = 1 / std::sqrt(1 + steepest * steepest);
  return ground;
}

bool touchesGround(const TerrainLattice& lattice, const Vec3d& center, double radius) {
  if (center.z - lattice.heightOver(center.x, center.y) <= radius) return true;
  if (groundBelow(lattice, center, radius).leastDistance() > radius) return false;
  bool isTouching = false;
  forEachTriangleNear(lattice, center, radius, false, [&](const TerrainLattice::Corners& corners, int) {
    isTouching = isTouching || isNear(corners, center, static_cast<float>(radius));
  });
  return isTouching;
}

}  // namespace cairn::bullet
