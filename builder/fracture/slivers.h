// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Removes triangles without area in double precision; they arise when the corners of exact cuts are rounded. Corners
/// closer than `tolerance` along an edge are joined. If a triangle's corner lies on its long edge, that edge is flipped
/// into the neighbour. No point of the surface moves by more than the tolerance. Triangles that neither step can remove
/// stay; `checkMesh` finds them. Precondition: every edge has two triangles. O(n log n).
TriangleMesh withoutSlivers(const TriangleMesh& mesh, double tolerance);

}  // namespace cairn::builder
