// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/planar_clusters.h"

namespace cairn::builder {

/// A point of the surface and the planar clusters it lies on: one, or all that meet at its edge or corner.
struct ClusterSample {
  Vec3d point;
  std::vector<std::uint32_t> clusters;  ///< ascending

  bool liesOn(std::uint32_t cluster) const;
};

/// Hubbard's sampling of a polyhedron (thesis 4.1.1, after Turk): `count` points spread at random by area, then pushed
/// apart within their clusters, and points along the clusters' edges about as dense, corners included (between corners
/// at most four times `count`: a needle's edges get fewer). The latter stand still and push as well, for what lies on
/// the other side of the edge. Mesh frame. A pure function.
std::vector<ClusterSample> relaxedSamples(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges,
                                          const PlanarClusters& clusters, std::size_t count, std::uint64_t seed);

}  // namespace cairn::builder
