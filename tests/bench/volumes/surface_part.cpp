// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/surface_part.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>

namespace cairn::bench {
namespace {

using builder::Piece;

// Middles of axes shorter than this share of the longest are not tried: cuts there leave the part as long as it is.
constexpr double kLeastShare = 0.4;
// Planes nearer than this share of its box to the part's own border separate nothing.
constexpr double kBorder = 1e-6;

Vec3d crossingOf(Vec3d a, Vec3d b, const AxisPlane& plane) {
  // The same bits from both sides of an edge.
  if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
  const double share = (plane.at - a[plane.axis]) / (b[plane.axis] - a[plane.axis]);
  Vec3d point = a + (b - a) * share;
  point[plane.axis] = plane.at;
  return point;
}

/// The part of a triangle on one side, as a fan of up to two triangles.
void appendSide(const Piece& piece, const AxisPlane& plane, double side, SurfacePart& out) {
  std::array<Vec3d, 4> corners;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &a = piece.corners[i], &b = piece.corners[(i + 1) % 3];
    const double heightA = side * (a[plane.axis] - plane.at), heightB = side * (b[plane.axis] - plane.at);
    if (heightA >= 0) corners[count++] = a;
    if (heightA * heightB < 0 && count < corners.size()) corners[count++] = crossingOf(a, b, plane);
  }
  for (std::size_t i = 2; i < count; ++i) out.push_back({{corners[0], corners[i - 1], corners[i]}, piece.source});
}

double normalAlong(const Piece& piece, int axis) {
  return cross(piece.corners[1] - piece.corners[0], piece.corners[2] - piece.corners[0])[axis];
}

}  // namespace

std::array<SurfacePart, 2> cut(const SurfacePart& part, const AxisPlane& plane) {
  std::array<SurfacePart, 2> sides;
  for (const Piece& piece : part) {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Vec3d& corner : piece.corners) {
      lowest = std::min(lowest, corner[plane.axis] - plane.at);
      highest = std::max(highest, corner[plane.axis] - plane.at);
    }
    if (lowest < 0 && highest > 0) {
      appendSide(piece, plane, -1, sides[0]);
      appendSide(piece, plane, 1, sides[1]);
    } else {
      const bool isAbove = lowest < 0 ? false : highest > 0 ? true : normalAlong(piece, plane.axis) < 0;
      sides[isAbove ? 1 : 0].push_back(piece);
    }
  }
  return sides;
}

std::array<std::vector<double>, 3> vertexCoordinates(const builder::TriangleMesh& mesh, std::size_t most) {
  std::array<std::vector<double>, 3> coordinates;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& at = coordinates[axis];
    for (const Vec3d& vertex : mesh.vertices) at.push_back(vertex[axis]);
    std::sort(at.begin(), at.end());
    at.erase(std::unique(at.begin(), at.end()), at.end());
    if (at.size() > most) at.clear();
  }
  return coordinates;
}

std::vector<AxisPlane> planesThrough(const SurfacePart& part, const std::array<std::vector<double>, 3>& coordinates) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec3d lower{kFar, kFar, kFar}, upper{-kFar, -kFar, -kFar};
  for (const Piece& piece : part)
    for (const Vec3d& corner : piece.corners)
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], corner[axis]);
        upper[axis] = std::max(upper[axis], corner[axis]);
      }
  const Vec3d size = upper - lower;
  const double longest = std::max({size.x, size.y, size.z});
  std::vector<AxisPlane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(size[axis] > 0)) continue;
    if (size[axis] >= kLeastShare * longest) planes.push_back({axis, lower[axis] + size[axis] / 2});
    for (const double at : coordinates[axis])
      if (at > lower[axis] + kBorder * longest && at < upper[axis] - kBorder * longest) planes.push_back({axis, at});
  }
  return planes;
}

}  // namespace cairn::bench
