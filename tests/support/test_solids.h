// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::test {

/// A closed triangle mesh with outward normals.
struct Solid {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

namespace detail {

// Shares vertices that fall into one place, so that patches generated one by one close up.
class SolidWriter {
 public:
  std::uint32_t vertex(const Vec3d& p) {
    const auto key = std::array{std::llround(p.x * 1e9), std::llround(p.y * 1e9), std::llround(p.z * 1e9)};
    const auto [it, isNew] = index_.try_emplace(key, static_cast<std::uint32_t>(solid.vertices.size()));
    if (isNew) solid.vertices.push_back(p);
    return it->second;
  }
  void triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    solid.triangles.push_back({vertex(a), vertex(b), vertex(c)});
  }
  /// A parallelogram from `corner`, cut into cells, facing cross(u, v).
  void patch(const Vec3d& corner, const Vec3d& u, const Vec3d& v, int cellsU, int cellsV) {
    for (int i = 0; i < cellsU; ++i)
      for (int j = 0; j < cellsV; ++j) {
        const auto at = [&](int di, int dj) {
          return corner + u * (double(i + di) / cellsU) + v * (double(j + dj) / cellsV);
        };
        triangle(at(0, 0), at(1, 0), at(1, 1));
        triangle(at(0, 0), at(1, 1), at(0, 1));
      }
  }
  Solid solid;

 private:
  std::map<std::array<long long, 3>, std::uint32_t> index_;
};

inline void addCuboid(SolidWriter& out, const Vec3d& lower, const Vec3d& upper, int cells) {
  const Vec3d s = upper - lower;
  const Vec3d x{s.x, 0, 0}, y{0, s.y, 0}, z{0, 0, s.z};
  out.patch(lower, y, x, cells, cells);
  out.patch(lower, x, z, cells, cells);
  out.patch(lower, z, y, cells, cells);
  out.patch(lower + z, x, y, cells, cells);
  out.patch(lower + y, z, x, cells, cells);
  out.patch(lower + x, y, z, cells, cells);
}

}  // namespace detail

/// A cuboid around the origin, each face cut into cells x cells squares.
inline Solid cuboid(const Vec3d& size, int cells) {
  detail::SolidWriter out;
  detail::addCuboid(out, size * -0.5, size * 0.5, cells);
  return out.solid;
}

/// Two cuboids that touch nowhere, as one (not connected) solid: a dumbbell without a bar, concave for certain.
inline Solid twoCuboids(const Vec3d& size, const Vec3d& apart, int cells) {
  detail::SolidWriter out;
  detail::addCuboid(out, apart * 0.5 - size * 0.5, apart * 0.5 + size * 0.5, cells);
  detail::addCuboid(out, apart * -0.5 - size * 0.5, apart * -0.5 + size * 0.5, cells);
  return out.solid;
}

/// A ball of this radius: an octahedron with each face cut into subdivisions^2 triangles, its vertices on the sphere.
inline Solid ball(double radius, int subdivisions) {
  detail::SolidWriter out;
  const auto onSphere = [&](const Vec3d& p) { return normalized(p) * radius; };
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3d x{octant & 1 ? -1.0 : 1.0, 0, 0}, y{0, octant & 2 ? -1.0 : 1.0, 0}, z{0, 0, octant & 4 ? -1.0 : 1.0};
    const bool mirrored = (octant & 1) ^ ((octant >> 1) & 1) ^ ((octant >> 2) & 1);
    const Vec3d a = x, b = mirrored ? z : y, c = mirrored ? y : z;
    const int n = subdivisions;
    const auto at = [&](int i, int j) { return onSphere(a * double(n - i - j) + b * double(i) + c * double(j)); };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        out.triangle(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) out.triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return out.solid;
}

/// The same solid of four times as many triangles: each is cut at the middles of its edges, in its own plane.
inline Solid quartered(const Solid& solid) {
  detail::SolidWriter out;
  for (const auto& [i, j, k] : solid.triangles) {
    const Vec3d &a = solid.vertices[i], &b = solid.vertices[j], &c = solid.vertices[k];
    const Vec3d ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
    out.triangle(a, ab, ca);
    out.triangle(ab, b, bc);
    out.triangle(ca, bc, c);
    out.triangle(ab, bc, ca);
  }
  return out.solid;
}

/// A valley along y between two planes that rise by `degrees` from its bottom, the origin, in a block that reaches
/// `width` to both sides, `depth` below the bottom and is `length` long.
inline Solid valley(double degrees, double width, double depth, double length, int cells) {
  detail::SolidWriter out;
  const double rise = width * std::tan(degrees * 3.14159265358979 / 180);
  // A side's profile, from the valley's middle outwards and up.
  const auto addSide = [&](double side) {
    const auto at = [&](int i, int j, int k) {  // across, up from the underside, along
      const double across = double(i) / cells, up = double(j) / cells;
      return Vec3d{side * width * across, length * (double(k) / cells - 0.5), up * (depth + rise * across) - depth};
    };
    const auto add = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
      out.triangle(a, side > 0 ? b : c, side > 0 ? c : b);
      out.triangle(a, side > 0 ? c : d, side > 0 ? d : c);
    };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        add(at(i, 0, j), at(i, 0, j + 1), at(i + 1, 0, j + 1), at(i + 1, 0, j));
        add(at(i, cells, j), at(i + 1, cells, j), at(i + 1, cells, j + 1), at(i, cells, j + 1));
        add(at(cells, i, j), at(cells, i, j + 1), at(cells, i + 1, j + 1), at(cells, i + 1, j));
        add(at(i, j, 0), at(i + 1, j, 0), at(i + 1, j + 1, 0), at(i, j + 1, 0));
        add(at(i, j, cells), at(i, j + 1, cells), at(i + 1, j + 1, cells), at(i + 1, j, cells));
      }
  };
  addSide(1);
  addSide(-1);
  return out.solid;
}

/// The solid that the profile sweeps when it turns about z: points (distance from the axis, height), in the order that
/// keeps the solid on the left; closed, or from axis to axis.
inline Solid revolved(const std::vector<std::array<double, 2>>& profile, int segments) {
  detail::SolidWriter out;
  const auto at = [&](std::size_t i, int k) {
    const double angle = 2 * 3.14159265358979 * (k % segments) / segments;
    const auto& [r, z] = profile[i % profile.size()];
    return Vec3d{r * std::cos(angle), r * std::sin(angle), z};
  };
  const bool isClosed = profile.front()[0] > 0;
  for (std::size_t i = 0; i + (isClosed ? 0 : 1) < profile.size(); ++i)
    for (int k = 0; k < segments; ++k) {
      const bool fromAxis = profile[i][0] == 0, toAxis = profile[(i + 1) % profile.size()][0] == 0;
      if (!fromAxis) out.triangle(at(i, k), at(i, k + 1), at(i + 1, k + 1));
      if (!toAxis) out.triangle(at(i, k), at(i + 1, k + 1), at(i + 1, k));
    }
  return out.solid;
}

/// A ring in the plane z = 0.
inline Solid torus(double ringRadius, double tubeRadius, int segments) {
  std::vector<std::array<double, 2>> tube;
  const int around = segments / 2;
  for (int k = 0; k < around; ++k) {
    const double angle = 2 * 3.14159265358979 * k / around;
    tube.push_back({ringRadius + tubeRadius * std::cos(angle), tubeRadius * std::sin(angle)});
  }
  return revolved(tube, segments);
}

/// Half of a hollow ball, open upwards, its rim at z = 0.
inline Solid bowl(double outerRadius, double innerRadius, int segments) {
  std::vector<std::array<double, 2>> profile;
  const int quarter = segments / 4;
  const auto add = [&](double radius, int k) {
    const double angle = 0.5 * 3.14159265358979 * k / quarter;
    profile.push_back({k == 0 ? 0 : radius * std::sin(angle), -radius * std::cos(angle)});
  };
  for (int k = 0; k <= quarter; ++k) add(outerRadius, k);
  for (int k = quarter; k >= 0; --k) add(innerRadius, k);
  return revolved(profile, segments);
}

}  // namespace cairn::test
