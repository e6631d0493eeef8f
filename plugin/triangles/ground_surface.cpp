// SPDX-License-Identifier: Zlib
#include "triangles/ground_surface.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Others may have no end, or show their triangles near the box alone.
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
  static std::mutex mutex;
  static std::map<const btConcaveShape*, std::weak_ptr<const GroundSurface>> known;
  if (!isMesh(shape)) return nullptr;
  const std::lock_guard lock(mutex);
  std::erase_if(known, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<const GroundSurface>& entry = known[&shape];
  std::shared_ptr<const GroundSurface> surface = entry.lock();
  if (!surface) entry = surface = std::shared_ptr<const GroundSurface>(new GroundSurface(shape));
  return surface;
}

GroundSurface::GroundSurface(const btConcaveShape& shape) {
  btVector3 lower, upper;
  shape.getAabb(btTransform::getIdentity(), lower, upper);
  soup_.gather(shape, lower, upper);
  if (soup_.triangles().empty() || soup_.triangles().size() > kMostTriangles) return;
  origin_ = soup_.triangles().front().corners[0];
  if (!weld()) return;
  for (const Corners& t : triangles_) reversed_.push_back({t[0], t[2], t[1]});
  derived_ = derivedFrom(vertices_, triangles_);
  findPieces();
}

// False, and no triangles, where a corner has no place.
bool GroundSurface::weld() {
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

TreeSurface GroundSurface::derivedFrom(std::span<const Vec3> vertices, std::span<const Corners> triangles) {
  TreeSurface surface;
  surface.features = SurfaceFeatures(vertices, triangles);
  surface.patches = SurfacePatches(vertices, triangles, surface.features);
  surface.thickness = surfaceThickness({vertices, triangles, &surface});
  return surface;
}

// Edges that join a triangle with none, with several or with one that shows the other side. Edges are in the order of
// their ends: one of several triangles comes several times in a row.
std::vector<bool> GroundSurface::looseEdges() const {
  const std::span<const SurfaceEdge> edges = derived_.features.edges();
  std::vector<bool> isLoose(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const SurfaceEdge& edge = edges[e];
    const bool isShared =
        (e > 0 && edges[e - 1].vertex == edge.vertex) || (e + 1 < edges.size() && edges[e + 1].vertex == edge.vertex);
    const auto runsAlong = [&](std::uint32_t triangle) {
      const Corners& t = triangles_[triangle];
      const auto at = static_cast<std::size_t>(std::ranges::find(t, edge.vertex[0]) - t.begin());
      return t[(at + 1) % 3] == edge.vertex[1];
    };
    isLoose[e] = isShared || edge.triangle[1] == SurfaceEdge::kNone ||
                 runsAlong(edge.triangle[0]) == runsAlong(edge.triangle[1]);
  }
  return isLoose;
}

void GroundSurface::findPieces() {
  constexpr std::uint32_t kUnseen = kNone;
  const std::vector<bool> isLoose = looseEdges();
  pieces_.assign(triangles_.size(), kUnseen);
  isOpen_.assign(triangles_.size(), false);
  std::vector<std::uint32_t> waiting;
  const auto visit = [&](std::uint32_t triangle, std::uint32_t piece) {
    if (pieces_[triangle] != kUnseen) return;
    pieces_[triangle] = piece;
    waiting.push_back(triangle);
  };
  for (std::uint32_t first = 0; first < triangles_.size(); ++first) {
    visit(first, first);
    while (!waiting.empty()) {
      const std::uint32_t at = waiting.back();
      waiting.pop_back();
      for (const std::uint32_t edge : derived_.features.edgesOf()[at]) {
        if (isLoose[edge]) isOpen_[pieces_[first]] = true;
        if (isLoose[edge]) continue;
        for (const std::uint32_t next : derived_.features.edges()[edge].triangle) visit(next, pieces_[first]);
      }
    }
  }
}

SurfaceView GroundSurface::view(bool isReversed) const {
  if (isReversed) std::call_once(isAskedForReversed_, [&] { derivedOfReversed_ = derivedFrom(vertices_, reversed_); });
  return isReversed ? SurfaceView{vertices_, reversed_, &derivedOfReversed_}
                    : SurfaceView{vertices_, triangles_, &derived_};
}

std::uint32_t GroundSurface::triangleOf(const TriangleSoup::Source& source) const {
  const int at = triangles_.empty() ? -1 : soup_.find(source);
  if (at < 0) return kNone;
  const TriangleSoup::Source& own = soup_.triangles()[static_cast<std::size_t>(at)];
  for (std::size_t k = 0; k < 3; ++k)
    if (!isSamePlace(own.corners[k], source.corners[k])) return kNone;
  return static_cast<std::uint32_t>(at);
}

}  // namespace cairn::bullet
