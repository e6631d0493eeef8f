// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/bonds.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "fracture/plane_axes.h"

namespace cairn::builder {
namespace {

using Point = PlanePoint;
using Polygon = std::vector<Point>;

double cross(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double areaOf(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += cross(polygon[0], polygon[i - 1], polygon[i]);
  return std::abs(twice) / 2;
}

// Clips a convex polygon to the left of a -> b (Sutherland and Hodgman 1974).
Polygon leftOf(const Polygon& polygon, const Point& a, const Point& b) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double here = cross(a, b, p), there = cross(a, b, q);
    if (here >= 0) kept.push_back(p);
    if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
      const double part = here / (here - there);
      kept.push_back({p.x + (q.x - p.x) * part, p.y + (q.y - p.y) * part});
    }
  }
  return kept;
}

using Flat = std::array<Point, 3>;  // counter-clockwise

// The triangles of a mesh that lie in the plane.
std::vector<Flat> facesIn(const TriangleMesh& mesh, const HalfSpace& plane, const PlaneAxes& axes, double tolerance) {
  std::vector<Flat> faces;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    bool lies = true;
    for (const Vec3d& corner : corners) lies = lies && std::abs(plane.heightOf(corner)) <= tolerance;
    if (!lies) continue;
    Flat flat{axes.of(corners[0]), axes.of(corners[1]), axes.of(corners[2])};
    if (cross(flat[0], flat[1], flat[2]) < 0) std::swap(flat[1], flat[2]);
    faces.push_back(flat);
  }
  return faces;
}

double overlap(const Flat& a, const Flat& b) {
  Polygon polygon(a.begin(), a.end());
  for (std::size_t i = 0; i < 3 && polygon.size() > 2; ++i) polygon = leftOf(polygon, b[i], b[(i + 1) % 3]);
  return areaOf(polygon);
}

}  // namespace

double commonArea(const TriangleMesh& behind, const TriangleMesh& before, const HalfSpace& plane, double tolerance) {
  const PlaneAxes axes(plane);
  const std::vector<Flat> ours = facesIn(behind, plane, axes, tolerance);
  if (ours.empty()) return 0;
  double area = 0;
  for (const Flat& theirs : facesIn(before, plane, axes, tolerance))
    for (const Flat& own : ours) area += overlap(own, theirs);
  return area;
}

}  // namespace cairn::builder
