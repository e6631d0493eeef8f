// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "fracture/half_space.h"

namespace cairn::builder {

/// Returns the part of a solid that lies in all half-spaces: one mesh for each connected part, none when it is empty.
/// Each crossing of an edge is computed once and rounded to doubles. The vertices of a cut's border close the cut, so
/// parts are closed by construction. Rounding may still make a part cross itself; `checkMesh` detects this. Planes
/// should not run through corners. Fails when a cut's border crosses itself. The same bits every time.
Result<std::vector<TriangleMesh>> cut(const TriangleMesh& solid, std::span<const HalfSpace> spaces);

}  // namespace cairn::builder
