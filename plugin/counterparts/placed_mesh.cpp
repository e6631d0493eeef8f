// SPDX-License-Identifier: Zlib
#include "counterparts/placed_mesh.h"

#include <algorithm>
#include <limits>

#include "counterparts/face_cone.h"

namespace cairn::bullet {

namespace {

// Cosine of the 10 degrees (`kConeSlack`) within which faces lie on each other.
constexpr float kFlushCosine = 0.984807753F;
// Fraction of a mesh's reach by which rounding may lift a vertex over the plane of a face it belongs to.
constexpr float kPlaneSlack = 1e-5F;

}  // namespace

Vec3 PlacedMesh::outwards(const SphereTree& tree, std::size_t triangle) {
  const auto& [i, j, k] = tree.triangles()[triangle];
  const Vec3 out = cross(tree.vertices()[j] - tree.vertices()[i], tree.vertices()[k] - tree.vertices()[i]);
  const float norm = length(out);
  return norm > 0 ? out / norm : Vec3();
}

bool PlacedMesh::isConvex(const SphereTree& tree) {
  for (std::size_t t = 0; t < tree.triangles().size(); ++t) {
    const Vec3 out = outwards(tree, t);
    const float plane = dot(out, tree.vertices()[tree.triangles()[t][0]]) + kPlaneSlack * tree.reach();
    if (std::ranges::any_of(tree.vertices(), [&](const Vec3& v) { return dot(out, v) > plane; })) return false;
  }
  return true;
}

PlacedMesh::PlacedMesh(const PlacedTree& placed, std::span<const Vec3> outwards)
    : tree_(placed.tree()), radius_(placed.sphere(kRootNode).radius) {
  for (std::size_t i = 0; i < tree_.vertices().size(); ++i) vertices_[i] = placed.toPair() * tree_.vertices()[i];
  const Mat3 pairFromAxes = transpose(placed.axesFromPair());
  for (std::size_t t = 0; t < tree_.triangles().size(); ++t) outwards_[t] = pairFromAxes * outwards[t];
}

DirectionalGap::Corners PlacedMesh::corners(std::size_t triangle, const WindowView& view) const {
  const auto& [i, j, k] = tree_.triangles()[triangle];
  return {view * vertices_[i], view * vertices_[j], view * vertices_[k]};
}

float PlacedMesh::lowest(const Vec3& direction) const {
  float lowest = std::numeric_limits<float>::max();
  for (const Vec3& v : vertices()) lowest = std::min(lowest, dot(direction, v));
  return lowest;
}

float PlacedMesh::lowest(std::size_t triangle, const Vec3& direction) const {
  const auto& [i, j, k] = tree_.triangles()[triangle];
  return std::min({dot(direction, vertices_[i]), dot(direction, vertices_[j]), dot(direction, vertices_[k])});
}

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
    const float below = height - height_[i] - kPlaneSlack * mesh.radius();
    if (below > 0 && below * below > kConeSlack * kConeSlack * lengthSq(vertices[i] - point)) return false;
  }
  return true;
}

}  // namespace cairn::bullet
