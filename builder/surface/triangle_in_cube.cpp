// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/triangle_in_cube.h"

namespace cairn::builder {
namespace {

/// A triangle cut by six planes has nine corners at most.
struct Polygon {
  std::array<Vec3d, 9> corners;
  std::size_t size = 0;
  void add(const Vec3d& corner) { corners[size++] = corner; }
};

}  // namespace

bool triangleMeetsCube(const std::array<Vec3d, 3>& corners, const Vec3d& center, double halfEdge) {
  Polygon polygon, clipped;
  for (const Vec3d& corner : corners) polygon.add(corner);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto height = [&](const Vec3d& p) { return halfEdge - side * (p[axis] - center[axis]); };
      clipped.size = 0;
      for (std::size_t i = 0; i < polygon.size; ++i) {
        const Vec3d &from = polygon.corners[i], &to = polygon.corners[(i + 1) % polygon.size];
        const double a = height(from), b = height(to);
        if (a >= 0) clipped.add(from);
        if ((a < 0) != (b < 0)) clipped.add(from + (to - from) * (a / (a - b)));
      }
      if (clipped.size == 0) return false;
      polygon = clipped;
    }
  return true;
}

}  // namespace cairn::builder
