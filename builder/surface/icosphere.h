// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Returns an icosahedron whose triangles are split in four `subdivisions` times. Corners lie on the unit sphere;
/// triangles face outward.
TriangleMesh unitIcosphere(int subdivisions);

}  // namespace cairn::builder
