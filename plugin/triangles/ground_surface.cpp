// SPDX-License-Identifier: Zlib
#include "triangles/ground_surface.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "kernel/contact_tuning.h"
#include "memory/shared_for.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Other concave shapes may be infinite, or show triangles only near the box.
bool isMesh(const btConcaveShape& shape) {
  switch (shape.getShapeType()) {
    case TRIANGLE_MESH_SHAPE_PROXYTYPE:
    case SCALED_TRIANGLE_MESH_SHAPE_PROXYTYPE:
    case MULTIMATERIAL_TRIANGLE_MESH_PROXYTYPE:
    case GIMPACT_SHAPE_PROXYTYPE:
      return true;
    default:
      return false;
  }
}

bool isSamePlace(const btVector3& p, const btVector3& q) {
  return p.x() == q.x() && p.y() == q.y() && p.z() == q.z();
}

}  // namespace

std::shared_ptr<const GroundSurface> GroundSurface::of(const btConcaveShape& shape) {
  static SharedFor<btConcaveShape, GroundSurface> known;
  if (!isMesh(shape)) return nullptr;
  // Callers check with `triangleOf` that the surface still matches the shape.
  return known.of(
      shape, [](const GroundSurface&) { return true; },
      [&] { return std::shared_ptr<const GroundSurface>(new GroundSurface(shape)); });
}

GroundSurface::GroundSurface(const btConcaveShape& shape) {
  btVector3 lower, upper;
  shape.getAabb(btTransform::getIdentity(), lower, upper);
  soup_.gather(shape, lower, upper);
  const std::size_t count = soup_.triangles().size();
  if (count > 0 && count <= tuning::kMaxTriangles && weld()) {
    derived_.features = SurfaceFeatures(vertices_, triangles_);
    isSolid_ = isClosed() && isInOnePiece() && volume() > 0;
  }
  if (!isSolid_) {
    soup_ = {};
    derived_ = {};
    return;
  }
  derived_.patches = SurfacePatches(vertices_, triangles_, derived_.features);
  derived_.thickness = surfaceThickness(view());
}

// False if a corner is not finite.
bool GroundSurface::weld() {
  origin_ = soup_.triangles().front().corners[0];
  std::vector<std::pair<btVector3, std::size_t>> corners;
  for (const TriangleSoup::Source& source : soup_.triangles())
    for (const btVector3& corner : source.corners) {
      if (!std::isfinite(corner.length2())) return false;
      corners.emplace_back(corner, corners.size());
    }
  const auto place = [](const std::pair<btVector3, std::size_t>& c) {
    return std::tuple(c.first.x(), c.first.y(), c.first.z(), c.second);
  };
  std::ranges::sort(corners, {}, place);
  triangles_.resize(soup_.triangles().size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == 0 || !isSamePlace(corners[i].first, corners[i - 1].first))
      vertices_.push_back(toVec3(corners[i].first - origin_));
    const std::size_t at = corners[i].second;
    triangles_[at / 3][at % 3] = static_cast<std::uint32_t>(vertices_.size() - 1);
  }
  return true;
}

// Edges are sorted by their ends, so an edge of more than two triangles appears several times in a row.
bool GroundSurface::isClosed() const {
  const std::span<const SurfaceEdge> edges = derived_.features.edges();
  const auto runsAlong = [&](const SurfaceEdge& edge, std::uint32_t triangle) {
    const auto& t = triangles_[triangle];
    const auto at = static_cast<std::size_t>(std::ranges::find(t, edge.vertex[0]) - t.begin());
    return t[(at + 1) % 3] == edge.vertex[1];
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const SurfaceEdge& edge = edges[e];
    if (edge.triangle[1] == SurfaceEdge::kNone || (e > 0 && edges[e - 1].vertex == edge.vertex)) return false;
    if (runsAlong(edge, edge.triangle[0]) == runsAlong(edge, edge.triangle[1])) return false;
  }
  return true;
}

// Precondition: closed.
bool GroundSurface::isInOnePiece() const {
  std::vector<bool> isSeen(triangles_.size());
  std::vector<std::uint32_t> waiting{0};
  isSeen[0] = true;
  std::size_t seen = 1;
  while (!waiting.empty()) {
    const std::uint32_t at = waiting.back();
    waiting.pop_back();
    for (const std::uint32_t edge : derived_.features.edgesOf()[at])
      for (const std::uint32_t next : derived_.features.edges()[edge].triangle) {
        if (isSeen[next]) continue;
        isSeen[next] = true;
        ++seen;
        waiting.push_back(next);
      }
  }
  return seen == triangles_.size();
}

// Precondition: closed.
double GroundSurface::volume() const {
  double sixfold = 0;
  for (const auto& t : triangles_)
    sixfold += dot(Vec3d(vertices_[t[0]]), cross(Vec3d(vertices_[t[1]]), Vec3d(vertices_[t[2]])));
  return sixfold / 6;
}

std::uint32_t GroundSurface::triangleOf(const TriangleSoup::Source& source) const {
  const int at = soup_.find(source);
  if (at < 0) return kNone;
  const TriangleSoup::Source& own = soup_.triangles()[static_cast<std::size_t>(at)];
  for (std::size_t k = 0; k < 3; ++k)
    if (!isSamePlace(own.corners[k], source.corners[k])) return kNone;
  return static_cast<std::uint32_t>(at);
}

}  // namespace cairn::bullet
