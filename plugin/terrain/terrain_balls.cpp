// SPDX-License-Identifier: Zlib
#include "terrain/terrain_balls.h"

#include "triangles/triangle.h"

namespace cairn::bullet {

namespace {

bool isNear(const TerrainLattice::Corners& t, const Vec3d& center, float radius) {
  const auto fromCenter = [&](int i) { return Vec3(toVec3d(t.at[i]) - center); };
  const Triangle triangle{fromCenter(0), fromCenter(1), fromCenter(2)};
  return lengthSq(nearestOnTriangle(triangle, Vec3()).point) <= radius * radius;
}

}  // namespace

bool isBelowGround(const TerrainLattice& lattice, const Vec3d& point) {
  TerrainLattice::Corners over;
  return lattice.cornersOver(point.x, point.y, over) && point.z < over.heightAt(point.x, point.y);
}

bool touchesGround(const TerrainLattice& lattice, const Vec3d& center, double radius) {
  TerrainLattice::Corners t;
  if (lattice.cornersOver(center.x, center.y, t) && center.z - radius <= t.heightAt(center.x, center.y)) return true;
  bool isTouching = false;
  forEachTriangleNear(lattice, center, radius, false, [&](const TerrainLattice::Corners& corners, int) {
    isTouching = isTouching || isNear(corners, center, static_cast<float>(radius));
  });
  return isTouching;
}

}  // namespace cairn::bullet
