// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/edges.h"

namespace cairn::builder {

/// Neighbouring triangles of one plane, as Hubbard treats them: a unit of the surface to put samples on (thesis 4.1.1).
struct PlanarClusters {
  std::vector<std::uint32_t> ofTriangle;
  std::vector<std::vector<std::uint32_t>> triangles;  ///< by cluster, ascending; the first one is in its plane exactly
  std::vector<Vec3d> normals;                         ///< by cluster, unit, outward

  std::size_t count() const { return triangles.size(); }
};

/// Clusters are numbered by their first triangle, which the normals of the others may leave by a degree at most.
/// O(n log n). Preconditions: `checkMesh(mesh)`; `halfEdges` are `sortedHalfEdges(mesh)`.
PlanarClusters planarClustersOf(const TriangleMesh& mesh, const std::vector<HalfEdge>& halfEdges);

}  // namespace cairn::builder
