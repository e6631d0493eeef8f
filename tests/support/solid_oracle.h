// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn::test {

/// Slow and simple answers about a closed mesh, to hold fast ones against: each looks at every triangle.
struct SolidOracle {
  std::span<const Vec3> vertices;
  std::span<const std::array<std::uint32_t, 3>> triangles;

  std::array<Vec3d, 3> corners(std::uint32_t t) const {
    return {Vec3d(vertices[triangles[t][0]]), Vec3d(vertices[triangles[t][1]]), Vec3d(vertices[triangles[t][2]])};
  }

  /// To the nearest point of the surface: on a side, or straight above a face.
  double toSurface(const Vec3d& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto c = corners(t);
      const Vec3d n = cross(c[1] - c[0], c[2] - c[0]);
      bool isAbove = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d a = c[k], ab = c[(k + 1) % 3] - a;
        least = std::min(least, length(p - a - ab * std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0)));
        isAbove = isAbove && dot(cross(ab, p - a), n) >= 0;
      }
      if (isAbove) least = std::min(least, std::abs(dot(p - c[0], n)) / length(n));
    }
    return least;
  }

  /// Solid angles over 4 pi: 1 inside, 0 outside.
  double windingNumber(const Vec3d& p) const {
    double angle = 0;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto c = corners(t);
      const Vec3d a = c[0] - p, b = c[1] - p, d = c[2] - p;
      const double la = length(a), lb = length(b), ld = length(d);
      angle += 2 * std::atan2(dot(a, cross(b, d)), la * lb * ld + dot(a, b) * ld + dot(b, d) * la + dot(d, a) * lb);
    }
    return angle / (4 * std::numbers::pi);
  }

  double toSolid(const Vec3d& p) const { return windingNumber(p) > 0.5 ? 0 : toSurface(p); }
};

}  // namespace cairn::test
