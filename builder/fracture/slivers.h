// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// The mesh without triangles that have no area as far as doubles can tell, which come of rounding what exact cuts
/// left: corners closer than `tolerance` along an edge become one, and the long edge of a triangle whose corner lies on
/// it is turned into the neighbour. No point of the surface moves by more than the tolerance. Leaves those it cannot
/// help; `checkMesh` finds them. Precondition: every edge has two triangles. O(n log n).
TriangleMesh withoutSlivers(const TriangleMesh& mesh, double tolerance);

}  // namespace cairn::builder
