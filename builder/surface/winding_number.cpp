// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/winding_number.h"

#include <cmath>
#include <numbers>

namespace cairn::builder {
namespace {

/// Returns half the solid angle of a triangle seen from the origin; positive when its outer side faces away.
double halfSolidAngle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  return std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

}  // namespace

double windingNumber(const TriangleMesh& mesh, const Vec3d& point) {
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    sum += halfSolidAngle(corners[0] - point, corners[1] - point, corners[2] - point);
  }
  return sum / (2 * std::numbers::pi);
}

}  // namespace cairn::builder
