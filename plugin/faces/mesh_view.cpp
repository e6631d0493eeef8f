// SPDX-License-Identifier: Zlib
#include "faces/mesh_view.h"

#include <algorithm>
#include <limits>

#include "placement/face_cone.h"

namespace cairn::bullet {

namespace {

// Cosine of the 10 degrees (`kConeSlack`) within which faces lie on each other.
constexpr float kFlushCosine = 0.984807753F;

}  // namespace

void MeshView::look(const PlacedMesh& mesh, const Vec3& direction) {
  isFacing_.reset();
  isFlush_.reset();
  isOnFlush_.reset();
  lowest_ = std::numeric_limits<float>::max();
  const std::span<const Vec3> vertices = mesh.vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    height_[i] = dot(direction, vertices[i]);
    lowest_ = std::min(lowest_, height_[i]);
  }
  for (std::size_t t = 0; t < mesh.outwards().size(); ++t) {
    const auto& [i, j, k] = mesh.tree().triangles()[t];
    lowestOf_[t] = std::min({height_[i], height_[j], height_[k]});
    const float cosine = dot(direction, mesh.outwards()[t]);
    isFacing_.set(t, cosine < 0);
    if (cosine > -kFlushCosine) continue;
    isFlush_.set(t);
    isOnFlush_.set(i).set(j).set(k);
  }
}

bool MeshView::isSaidByFlush(const PlacedMesh& mesh, std::size_t triangle, float limit) const {
  return std::ranges::all_of(mesh.tree().triangles()[triangle],
                             [&](std::uint32_t v) { return isOnFlush_[v] || height_[v] >= limit; });
}

bool MeshView::isExtreme(const PlacedMesh& mesh, const Vec3& point, float height) const {
  const std::span<const Vec3> vertices = mesh.vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const float below = height - height_[i] - PlacedMesh::kPlaneSlack * mesh.radius();
    if (below > 0 && below * below > kConeSlack * kConeSlack * lengthSq(vertices[i] - point)) return false;
  }
  return true;
}

}  // namespace cairn::bullet
