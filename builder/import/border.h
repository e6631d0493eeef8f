// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/edges.h"

namespace cairn::builder {

/// Returns the edges with only one triangle, in the direction of that triangle.
std::vector<HalfEdge> borderEdges(const TriangleMesh& mesh);

/// Returns the rims of the holes as closed loops of border edges, in the direction of the triangles beside them. No
/// loop passes a vertex twice; holes that meet in a vertex have separate loops. Edges that close no loop are left out;
/// inconsistent triangles cause such edges. Linear except for the sort of the edges.
std::vector<std::vector<HalfEdge>> borderLoops(const TriangleMesh& mesh);

}  // namespace cairn::builder
