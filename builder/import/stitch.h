// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/repair.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Drops every triangle with the same three vertices as an earlier one that faces the same way. Where triangles do not
/// cancel at all edges then, it drops them whichever way they face. Where they cancel only as they are, all stay:
/// bodies share a face.
void dropDuplicates(TriangleMesh& mesh, RepairCounts& counts);

/// Joins border vertices within `tolerance` of each other to the one with the lowest number. Triangles that lose their
/// area are dropped. Only border vertices move. O(n log n).
void joinBorders(TriangleMesh& mesh, double tolerance, RepairCounts& counts);

/// Splits triangles where a border vertex lies within `tolerance` of their border edge. A long edge and the short ones
/// along it then become the same edges. No vertex moves. Cost: up to the square of the number of border edges.
void splitAtBorderVertices(TriangleMesh& mesh, double tolerance, RepairCounts& counts);

}  // namespace cairn::builder
