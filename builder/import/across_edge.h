// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Two unit vectors across an edge and each other: u, v and the edge's direction are right-handed in the order u, v.
struct AcrossEdge {
  Vec3d u, v;
};

/// `along`: the edge's unit direction. The same direction gives the same vectors, bit for bit.
inline AcrossEdge acrossEdge(const Vec3d& along) {
  int least = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(along[axis]) < std::abs(along[least])) least = axis;
  Vec3d helper;
  helper[least] = 1;
  const Vec3d u = normalized(cross(along, helper));
  return {u, cross(along, u)};
}

}  // namespace cairn::builder
