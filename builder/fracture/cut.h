// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "fracture/half_space.h"

namespace cairn::builder {

/// What of a solid lies in all the half-spaces, one mesh for each part that hangs together; nothing where it is empty.
/// Each crossing of an edge is computed once and rounded to doubles; cuts are closed by their borders' own vertices. So
/// parts are closed by construction; whether rounding made one cross itself is for `checkMesh` to say. Planes should
/// not run through corners. Fails when a cut's border crosses itself. The same bits every time.
Result<std::vector<TriangleMesh>> cut(const TriangleMesh& solid, std::span<const HalfSpace> spaces);

}  // namespace cairn::builder
