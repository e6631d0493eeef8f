// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/planar_clusters.h"

#include <algorithm>

namespace cairn::builder {

namespace {

/// Cosine of one degree.
constexpr double kSamePlane = 0.99985;
constexpr std::uint32_t kNone = ~0U;

std::vector<std::vector<std::uint32_t>> neighboursOf(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges) {
  std::vector<std::vector<std::uint32_t>> neighbours(mesh.triangles.size());
  for (std::size_t i = 1; i < halfEdges.size(); ++i) {
    if (!halfEdges[i].sameEdge(halfEdges[i - 1])) continue;
    neighbours[halfEdges[i].triangle].push_back(halfEdges[i - 1].triangle);
    neighbours[halfEdges[i - 1].triangle].push_back(halfEdges[i].triangle);
  }
  return neighbours;
}

Vec3d normalOf(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = mesh.corners(triangle);
  return normalized(cross(b - a, c - a));
}

}  // namespace

PlanarClusters planarClustersOf(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges) {
  const auto neighbours = neighboursOf(mesh, halfEdges);
  PlanarClusters clusters;
  clusters.ofTriangle.assign(mesh.triangles.size(), kNone);
  for (std::uint32_t first = 0; first < mesh.triangles.size(); ++first) {
    if (clusters.ofTriangle[first] != kNone) continue;
    const auto cluster = static_cast<std::uint32_t>(clusters.count());
    const Vec3d normal = normalOf(mesh, first);
    std::vector<std::uint32_t> members{first};
    clusters.ofTriangle[first] = cluster;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (const std::uint32_t t : neighbours[members[i]])
        if (clusters.ofTriangle[t] == kNone && dot(normalOf(mesh, t), normal) >= kSamePlane) {
          clusters.ofTriangle[t] = cluster;
          members.push_back(t);
        }
    std::sort(members.begin(), members.end());
    clusters.triangles.push_back(std::move(members));
    clusters.normals.push_back(normal);
  }
  return clusters;
}

}  // namespace cairn::builder
