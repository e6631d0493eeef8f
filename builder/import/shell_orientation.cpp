// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/shell_orientation.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace cairn::builder {
namespace {

struct Shell {
  std::vector<std::uint32_t> triangles;
  Bounds bounds;
  double volume = 0;
};

void extend(Bounds& bounds, const Vec3d& p) {
  for (int axis = 0; axis < 3; ++axis) {
    bounds.lower[axis] = std::fmin(bounds.lower[axis], p[axis]);
    bounds.upper[axis] = std::fmax(bounds.upper[axis], p[axis]);
  }
}

bool contains(const Bounds& bounds, const Vec3d& p) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < bounds.lower[axis] || p[axis] > bounds.upper[axis]) return false;
  return true;
}

std::vector<Shell> collect(const TriangleMesh& mesh, const Shells& shells) {
  std::vector<Shell> list(shells.count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Shell& shell = list[shells.ofTriangle[t]];
    const auto corners = mesh.corners(t);
    if (shell.triangles.empty()) shell.bounds = {corners[0], corners[0]};
    shell.triangles.push_back(t);
    for (const Vec3d& c : corners) extend(shell.bounds, c);
  }
  for (Shell& shell : list) {
    const Vec3d reference = shell.bounds.center();
    for (const std::uint32_t t : shell.triangles) {
      const auto c = mesh.corners(t);
      shell.volume += dot(c[0] - reference, cross(c[1] - reference, c[2] - reference)) / 6;
    }
  }
  return list;
}

/// Returns the winding number of a shell around a point that is not on it. It is +1 inside a shell that faces outward,
/// -1 inside one that faces inward. It is the sum of the triangles' solid angles (van Oosterom and Strackee 1983).
int windingNumber(const TriangleMesh& mesh, const Shell& shell, const Vec3d& point) {
  double angle = 0;
  for (const std::uint32_t t : shell.triangles) {
    const auto c = mesh.corners(t);
    const Vec3d a = normalized(c[0] - point), b = normalized(c[1] - point), d = normalized(c[2] - point);
    angle += 2 * std::atan2(dot(a, cross(b, d)), 1 + dot(a, b) + dot(b, d) + dot(d, a));
  }
  return static_cast<int>(std::lround(angle / (4 * std::numbers::pi)));
}

}  // namespace

std::optional<MisplacedShell> findMisplacedShell(const TriangleMesh& mesh, const Shells& shells) {
  const std::vector<Shell> list = collect(mesh, shells);
  for (const Shell& shell : list) {
    const auto [a, b, c] = mesh.corners(shell.triangles.front());
    const Vec3d point = (a + b + c) / 3.0;  // shells may share a corner
    int around = 0;
    for (const Shell& other : list) {
      if (&other != &shell && contains(other.bounds, point)) around += windingNumber(mesh, other, point);
    }
    const bool outward = shell.volume > 0;
    if (around != (outward ? 0 : 1)) return MisplacedShell{shell.triangles.front(), outward};
  }
  return std::nullopt;
}

}  // namespace cairn::builder
