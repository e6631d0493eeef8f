// SPDX-License-Identifier: GPL-3.0-or-later
#include "convexity.h"

#include <algorithm>
#include <cstdint>

namespace cairn::builder {

namespace {
constexpr std::size_t kMaxTriangles = 20000;
}

bool isConvex(const TriangleMesh& mesh, double tolerance) {
  if (mesh.triangles.size() > kMaxTriangles) return false;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = mesh.corners(t);
    const Vec3d normal = cross(c[1] - c[0], c[2] - c[0]);
    const double allowed = dot(normal, c[0]) + tolerance * length(normal);
    if (std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                    [&](const Vec3d& v) { return dot(normal, v) > allowed; }))
      return false;
  }
  return true;
}

}  // namespace cairn::builder
