// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/planar_clusters.h"

namespace cairn::builder {

/// A point of the surface and its planar clusters: one, or all that meet at the point's edge or corner.
struct ClusterSample {
  Vec3d point;
  std::vector<std::uint32_t> clusters;  ///< ascending

  bool liesOn(std::uint32_t cluster) const;
};

/// Hubbard's sampling of a polyhedron (thesis 4.1.1, after Turk). `count` points are spread at random by area, then
/// pushed apart within their clusters. Points along the clusters' edges have about the same density, corners included.
/// Between corners there are at most four times `count`, so a needle's edges get fewer. Edge points stand still, but
/// push too, on behalf of the surface beyond the edge. Mesh frame. A pure function.
std::vector<ClusterSample> relaxedSamples(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges,
                                          const PlanarClusters& clusters, std::size_t count, std::uint64_t seed);

}  // namespace cairn::builder
