// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/edges.h"

namespace cairn::builder {

/// Neighbouring triangles of one plane, after Hubbard: a unit of the surface that receives samples (thesis 4.1.1).
struct PlanarClusters {
  std::vector<std::uint32_t> ofTriangle;
  std::vector<std::vector<std::uint32_t>>
      triangles;               ///< by cluster, ascending; the first triangle lies exactly in the cluster's plane
  std::vector<Vec3d> normals;  ///< by cluster, unit, outward

  std::size_t count() const { return triangles.size(); }
};

/// Finds the clusters, numbered by their first triangle. The other normals of a cluster differ from the first by at
/// most a degree. O(n log n). Preconditions: `checkMesh(mesh)`; `halfEdges` are `sortedHalfEdges(mesh)`.
PlanarClusters planarClustersOf(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges);

}  // namespace cairn::builder
