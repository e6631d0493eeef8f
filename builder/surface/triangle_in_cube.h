// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// True when a triangle meets a cube, faces included. Rounding may change the answer within a few units in the last
/// place of the coordinates. Callers that must find all triangles widen the cube by far more than that.
bool triangleMeetsCube(const std::array<Vec3d, 3>& corners, const Vec3d& center, double halfEdge);

}  // namespace cairn::builder
