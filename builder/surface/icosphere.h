// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// An icosahedron whose triangles are split in four `subdivisions` times, corners on the unit sphere, outward.
TriangleMesh unitIcosphere(int subdivisions);

}  // namespace cairn::builder
