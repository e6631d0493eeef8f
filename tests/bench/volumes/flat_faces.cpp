// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/flat_faces.h"

#include <algorithm>
#include <cmath>

#include "surface/edges.h"
#include "volumes/hull_2d.h"

namespace cairn::bench {
namespace {

using builder::HalfEdge;
using builder::TriangleMesh;

// Larger faces cost more distances than they save.
constexpr std::size_t kMostTriangles = 32;
// Of the diagonal: what a face may miss of its hull. A missing area of kMissingArea diagonals squared holds no disc of
// a larger radius than kGuard, and kOffPlane is less.
constexpr double kOffPlane = 1e-12, kMissingArea = 1e-12, kGuard = 1e-6;

/// Unit normal and offset of a triangle's plane.
struct Plane {
  Vec3d normal;
  double offset = 0;
};

Plane planeOf(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = mesh.corners(triangle);
  const Vec3d normal = normalized(cross(b - a, c - a));
  return {normal, dot(normal, a)};
}

double areaOfHull(const std::vector<Point2>& hull) {
  double twice = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

class FaceSearch {
 public:
  explicit FaceSearch(const TriangleMesh& mesh)
      : mesh_(mesh), neighbours_(mesh.triangles.size()), size_(boundsOf(mesh).diagonal()) {
    const std::vector<HalfEdge> edges = builder::sortedHalfEdges(mesh);
    for (std::size_t i = 1; i < edges.size(); ++i)
      if (edges[i].sameEdge(edges[i - 1])) {
        neighbours_[edges[i].triangle].push_back(edges[i - 1].triangle);
        neighbours_[edges[i - 1].triangle].push_back(edges[i].triangle);
      }
  }

  /// The triangles of the first one's plane that are reached from it through edges, itself first.
  std::vector<std::uint32_t> faceOf(std::uint32_t triangle) const {
    const Plane plane = planeOf(mesh_, triangle);
    std::vector<std::uint32_t> face{triangle};
    for (std::size_t i = 0; i < face.size() && face.size() <= kMostTriangles; ++i)
      for (const std::uint32_t next : neighbours_[face[i]])
        if (liesIn(plane, next) && std::find(face.begin(), face.end(), next) == face.end()) face.push_back(next);
    return face;
  }

  bool isConvex(const std::vector<std::uint32_t>& face) const {
    const Plane plane = planeOf(mesh_, face[0]);
    const auto [a, b, c] = mesh_.corners(face[0]);
    const Vec3d u = normalized(b - a), v = cross(plane.normal, u);
    std::vector<Point2> flat;
    double area = 0;
    for (const std::uint32_t triangle : face) {
      const auto corners = mesh_.corners(triangle);
      for (const Vec3d& corner : corners) flat.push_back({dot(corner - a, u), dot(corner - a, v)});
      area += 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
    }
    return std::abs(areaOfHull(hullOf(flat)) - area) <= kMissingArea * size_ * size_;
  }

 private:
  bool liesIn(const Plane& plane, std::uint32_t triangle) const {
    for (const Vec3d& corner : mesh_.corners(triangle))
      if (std::abs(dot(plane.normal, corner) - plane.offset) > kOffPlane * size_) return false;
    return dot(plane.normal, planeOf(mesh_, triangle).normal) > 0;
  }

  const TriangleMesh& mesh_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  double size_;
};

}  // namespace

FlatFaces::FlatFaces(const TriangleMesh& mesh) : faces_(mesh.triangles.size()) {
  const FaceSearch search(mesh);
  guard_ = kGuard * boundsOf(mesh).diagonal();
  for (std::uint32_t triangle = 0; triangle < faces_.size(); ++triangle) {
    std::vector<std::uint32_t> face = search.faceOf(triangle);
    if (face.size() > kMostTriangles || (face.size() > 1 && !search.isConvex(face))) face = {triangle};
    faces_[triangle] = {static_cast<std::uint32_t>(triangles_.size()), static_cast<std::uint32_t>(face.size())};
    triangles_.insert(triangles_.end(), face.begin(), face.end());
  }
}

}  // namespace cairn::bench
