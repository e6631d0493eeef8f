// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/truth/placed_body.h"

#include <algorithm>
#include <limits>

namespace cairn::scenes {

bool Box::overlaps(const Box& o) const {
  for (int axis = 0; axis < 3; ++axis)
    if (lower[axis] > o.upper[axis] || o.lower[axis] > upper[axis]) return false;
  return true;
}

Placement placementOf(const btTransform& pose) {
  const btMatrix3x3& m = pose.getBasis();
  const Vec3d x = normalized(fromBullet(m.getColumn(0)));
  const Vec3d yRaw = fromBullet(m.getColumn(1));
  const Vec3d y = normalized(yRaw - x * dot(x, yRaw));
  const Mat3d columns{{x, y, cross(x, y)}};
  return {transpose(columns), fromBullet(pose.getOrigin())};
}

PlacedBody placeBody(const btTransform& pose, const Model& model) {
  PlacedBody placed{placementOf(pose), {}, {}};
  const double infinity = std::numeric_limits<double>::infinity();
  placed.box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const Vec3d& v : model.vertices) {
    const Vec3d p = placed.vertices.emplace_back(placed.worldFromBody * v);
    for (int axis = 0; axis < 3; ++axis) {
      placed.box.lower[axis] = std::min(placed.box.lower[axis], p[axis]);
      placed.box.upper[axis] = std::max(placed.box.upper[axis], p[axis]);
    }
  }
  return placed;
}

}  // namespace cairn::scenes
