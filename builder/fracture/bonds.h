// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"
#include "fracture/half_space.h"

namespace cairn::builder {

/// The area two solids have in common on a plane that is a face of both, the first behind it and the second before it:
/// twice covered parts counted once. `tolerance`: how far corners of faces may lie off the plane.
double commonArea(const TriangleMesh& behind, const TriangleMesh& before, const HalfSpace& plane, double tolerance);

}  // namespace cairn::builder
