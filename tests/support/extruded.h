// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "test_solids.h"

namespace cairn::test {

using Outline = std::vector<std::array<double, 2>>;

namespace detail {

inline double turnOf(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// By cutting off ears: corners whose triangle holds no other corner.
inline std::vector<std::array<std::uint32_t, 3>> triangulated(const Outline& outline) {
  std::vector<std::uint32_t> left(outline.size());
  for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto isEar = [&](std::size_t i) {
    const std::uint32_t a = left[(i + left.size() - 1) % left.size()], b = left[i], c = left[(i + 1) % left.size()];
    if (turnOf(outline[a], outline[b], outline[c]) <= 1e-12) return false;
    for (const std::uint32_t p : left) {
      if (p == a || p == b || p == c) continue;
      if (turnOf(outline[a], outline[b], outline[p]) >= 0 && turnOf(outline[b], outline[c], outline[p]) >= 0 &&
          turnOf(outline[c], outline[a], outline[p]) >= 0)
        return false;
    }
    return true;
  };
  while (left.size() > 2) {
    std::size_t ear = 0;
    while (ear < left.size() && !isEar(ear)) ++ear;
    if (ear == left.size()) break;
    triangles.push_back({left[(ear + left.size() - 1) % left.size()], left[ear], left[(ear + 1) % left.size()]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace detail

/// A prism along z from `lower` to `upper`; the outline runs counterclockwise and does not cross itself.
inline Solid extruded(const Outline& outline, double lower, double upper) {
  detail::SolidWriter out;
  const auto at = [&](std::uint32_t i, double z) { return Vec3d(outline[i][0], outline[i][1], z); };
  for (const auto& [a, b, c] : detail::triangulated(outline)) {
    out.triangle(at(a, upper), at(b, upper), at(c, upper));
    out.triangle(at(c, lower), at(b, lower), at(a, lower));
  }
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (std::uint32_t i = 0; i < count; ++i)
    out.patch(at(i, lower), at((i + 1) % count, lower) - at(i, lower), Vec3d(0, 0, upper - lower), 1, 1);
  return out.solid;
}

/// A square block of this half width with a round hole along z.
inline Solid holedBlock(double halfWidth, double hole, int sides, double lower, double upper) {
  detail::SolidWriter out;
  const auto inner = [&](int i, double z) {
    const double angle = 2 * std::numbers::pi * i / sides;
    return Vec3d(hole * std::cos(angle), hole * std::sin(angle), z);
  };
  const auto outer = [&](int i, double z) {
    const Vec3d p = inner(i, z);
    const double scale = halfWidth / std::max(std::abs(p.x), std::abs(p.y));
    return Vec3d(p.x * scale, p.y * scale, z);
  };
  const auto quad = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    out.triangle(a, b, c);
    out.triangle(a, c, d);
  };
  for (int i = 0; i < sides; ++i) {
    quad(inner(i, upper), outer(i, upper), outer(i + 1, upper), inner(i + 1, upper));
    quad(inner(i + 1, lower), outer(i + 1, lower), outer(i, lower), inner(i, lower));
    quad(inner(i, lower), inner(i, upper), inner(i + 1, upper), inner(i + 1, lower));
    quad(outer(i + 1, lower), outer(i + 1, upper), outer(i, upper), outer(i, lower));
  }
  return out.solid;
}

inline Outline circle(double radius, int sides) {
  Outline outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

}  // namespace cairn::test
