// SPDX-License-Identifier: Zlib
#pragma once

#include <span>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Sine of the 10 degrees by which a direction may miss a region's normals and still count as one. Bodies at rest are
/// hardly ever exactly parallel.
inline constexpr float kConeSlack = 0.173648178F;

/// Whether a unit direction is among the outward normals of a corner, an edge or a face. These form the cone that up to
/// three unit face normals span; a miss by `kConeSlack` is allowed. In any other direction a region's extreme point is
/// not the body's: it lies where the region ends and its neighbour begins.
bool isAmongNormals(std::span<const Vec3> faces, const Vec3& direction);

}  // namespace cairn::bullet
