// SPDX-License-Identifier: Zlib
#include "colliders/hull_faces.h"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <limits>

#include "kernel/contact_tuning.h"
#include "memory/shared_for.h"
#include "placement/bullet_math.h"
#include "placement/triangle.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

namespace {

btVector3 cornerOf(const btPolyhedralConvexShape& shape, int index) {
  btVector3 corner;
  shape.getVertex(index, corner);
  return corner;
}

// The area of the whole face: thin triangles of its fan would have inexact normals of their own.
Vec3d areaOf(const std::vector<Vec3d>& polygon) {
  Vec3d area;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    area = area + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return area;
}

}  // namespace

std::shared_ptr<const HullFaces> HullFaces::of(const btPolyhedralConvexShape& shape) {
  static SharedFor<btPolyhedralConvexShape, HullFaces> known;
  const int count = shape.getNumVertices();
  if (count < 4 || count > tuning::kMaxHullVertices) return nullptr;
  const std::shared_ptr<const HullFaces> faces = known.of(
      shape, [&](const HullFaces& hull) { return hull.isOf(shape); },
      [&] { return std::shared_ptr<const HullFaces>(new HullFaces(shape)); });
  return faces->faces_.empty() ? nullptr : faces;
}

// The hull is found on a grid of some ten thousand steps. Corners that stick out by less are left out, but every plane
// still supports them. Two faces back to back have no inside.
HullFaces::HullFaces(const btPolyhedralConvexShape& shape) {
  for (int i = 0; i < shape.getNumVertices(); ++i) corners_.push_back(cornerOf(shape, i));
  const auto isFinite = [](const btVector3& corner) { return std::isfinite(double(corner.length2())); };
  if (!std::ranges::all_of(corners_, isFinite)) return;
  btConvexHullComputer hull;
  hull.compute(&corners_[0][0], sizeof(btVector3), static_cast<int>(corners_.size()), 0, 0);
  if (hull.faces.size() < 4) return;
  std::vector<Vec3d> polygon;
  for (int f = 0; f < hull.faces.size(); ++f) {
    polygon.clear();
    const btConvexHullComputer::Edge *const first = &hull.edges[hull.faces[f]], *edge = first;
    do {
      const int corner = hull.original_vertex_index[edge->getSourceVertex()];
      polygon.push_back(toVec3d(corners_[static_cast<std::size_t>(corner)]));
      edge = edge->getNextEdgeOfFace();
    } while (edge != first);
    const Vec3d area = areaOf(polygon);
    if (area == Vec3d()) continue;
    const Vec3 normal = Vec3(normalized(area));
    float offset = -std::numeric_limits<float>::infinity();
    for (const btVector3& corner : corners_)
      offset = std::max(offset, static_cast<float>(dot(Vec3d(normal), toVec3d(corner))));
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      faces_.push_back({{Vec3(polygon[0]), Vec3(polygon[i]), Vec3(polygon[i + 1])}, normal, offset});
  }
}

bool HullFaces::isOf(const btPolyhedralConvexShape& shape) const {
  if (shape.getNumVertices() != static_cast<int>(corners_.size())) return false;
  for (int i = 0; i < shape.getNumVertices(); ++i)
    if (cornerOf(shape, i) != corners_[static_cast<std::size_t>(i)]) return false;
  return true;
}

float HullFaces::heightAbove(const Vec3& p) const {
  float maxHeight = -std::numeric_limits<float>::infinity();
  for (const Face& face : faces_) maxHeight = std::max(maxHeight, dot(face.normal, p) - face.offset);
  return maxHeight;
}

// Behind all planes: the nearest plane. Else: the nearest point of the faces whose outer side faces the point; the
// nearest is never on another face.
NearestPoint HullFaces::nearest(const Vec3& p) const {
  const auto height = [&](const Face& face) { return dot(face.normal, p) - face.offset; };
  const Face& highest = *std::ranges::max_element(faces_, {}, height);
  const float maxHeight = height(highest);
  if (maxHeight <= 0) return {p - highest.normal * maxHeight, highest.normal, maxHeight};
  const auto nearestOn = [&](const Face& face) {
    return nearestOnTriangle({face.corner[0], face.corner[1], face.corner[2]}, p);
  };
  if (const TrianglePoint on = nearestOn(highest); on.onFace) return {on.point, highest.normal, maxHeight};
  NearestPoint nearest{{}, {}, std::numeric_limits<float>::infinity()};
  for (const Face& face : faces_) {
    const float above = height(face);
    if (above <= 0 || above >= nearest.distance) continue;
    const TrianglePoint on = nearestOn(face);
    if (on.onFace) return {on.point, face.normal, above};
    const Vec3 toPoint = p - on.point;
    const float distance = length(toPoint);
    if (distance >= nearest.distance) continue;
    nearest = {on.point, toPoint == Vec3() ? highest.normal : unitVector(toPoint), distance};
  }
  return nearest;
}

}  // namespace cairn::bullet
