// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Whether a triangle meets a cube, faces included, but for rounding: a few units in the last place of the coordinates.
/// What must not miss any widens the cube by far more than that.
bool triangleMeetsCube(const std::array<Vec3d, 3>& corners, const Vec3d& center, double halfEdge);

}  // namespace cairn::builder
