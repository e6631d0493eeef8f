// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/edges.h"

namespace cairn::builder {

/// The edges that belong to one triangle only, as that triangle runs along them.
std::vector<HalfEdge> borderEdges(const TriangleMesh& mesh);

/// The rims of the holes: closed loops of border edges, each running as the triangles beside it do, none passing a
/// vertex twice; where holes meet in a vertex each has its own loop. Edges that close no loop, which inconsistent
/// triangles leave, are left out. Linear but for the sorting of the edges.
std::vector<std::vector<HalfEdge>> borderLoops(const TriangleMesh& mesh);

}  // namespace cairn::builder
