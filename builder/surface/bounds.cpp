// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cassert>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

Bounds boundsOf(const TriangleMesh& mesh) {
  assert(!mesh.vertices.empty());
  Bounds bounds{mesh.vertices.front(), mesh.vertices.front()};
  for (const Vec3d& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      bounds.lower[axis] = std::min(bounds.lower[axis], v[axis]);
      bounds.upper[axis] = std::max(bounds.upper[axis], v[axis]);
    }
  }
  return bounds;
}

}  // namespace cairn::builder
