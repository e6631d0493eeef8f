// SPDX-License-Identifier: Zlib
#include "faces/placed_mesh.h"
#include "placement/unit_vector.h"

#include <algorithm>
#include <limits>

namespace cairn::bullet {

Vec3 PlacedMesh::outwards(const SphereTree& tree, std::size_t triangle) {
  const auto& [i, j, k] = tree.triangles()[triangle];
  return unitVector(cross(tree.vertices()[j] - tree.vertices()[i], tree.vertices()[k] - tree.vertices()[i]));
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

}  // namespace cairn::bullet
