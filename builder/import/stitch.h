// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/repair.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Leaves out every triangle that has the same three vertices as an earlier one, whichever way it faces.
void dropDuplicates(TriangleMesh& mesh, RepairCounts& counts);

/// Border vertices within `tolerance` of each other become the one of them with the lowest number, and triangles that
/// lose their area by that are left out. Only borders move. O(n log n).
void joinBorders(TriangleMesh& mesh, double tolerance, RepairCounts& counts);

/// Splits triangles where a border vertex lies within `tolerance` of their border edge, so that a long edge and the
/// short ones along it become the same edges. No vertex moves. Up to the square of the number of border edges.
void splitAtBorderVertices(TriangleMesh& mesh, double tolerance, RepairCounts& counts);

}  // namespace cairn::builder
