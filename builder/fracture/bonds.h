// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"
#include "fracture/half_space.h"

namespace cairn::builder {

/// Returns the area that two solids share on a plane that is a face of both. The first solid lies behind the plane, the
/// second before it. Parts covered twice count once. `tolerance`: largest distance of the faces' corners from the
/// plane.
double commonArea(const TriangleMesh& behind, const TriangleMesh& before, const HalfSpace& plane, double tolerance);

}  // namespace cairn::builder
