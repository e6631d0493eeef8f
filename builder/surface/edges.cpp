// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edges.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace cairn::builder {

std::vector<HalfEdge> sortedHalfEdges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> halfEdges;
  halfEdges.reserve(mesh.triangles.size() * 3);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& v = mesh.triangles[t];
    for (std::uint32_t i = 0; i < 3; ++i) halfEdges.push_back({v[i], v[(i + 1) % 3], t, i});
  }
  const auto key = [](const HalfEdge& h) { return std::tuple(h.low(), h.high(), h.triangle); };
  std::sort(halfEdges.begin(), halfEdges.end(), [&](const HalfEdge& a, const HalfEdge& b) { return key(a) < key(b); });
  return halfEdges;
}

Shells shellsOf(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges) {
  // Union-find; the root of a set is its lowest triangle.
  std::vector<std::uint32_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (std::size_t i = 1; i < halfEdges.size(); ++i) {
    if (!halfEdges[i].sameEdge(halfEdges[i - 1])) continue;
    const std::uint32_t a = root(halfEdges[i].triangle), b = root(halfEdges[i - 1].triangle);
    parent[std::max(a, b)] = std::min(a, b);
  }
  Shells shells{std::vector<std::uint32_t>(mesh.triangles.size()), 0};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    shells.ofTriangle[t] = root(t) == t ? shells.count++ : shells.ofTriangle[root(t)];
  return shells;
}

}  // namespace cairn::builder
