// SPDX-License-Identifier: Zlib
#pragma once

#include <span>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Sine of the 10 degrees by which a direction may miss a region's normals and still count as one of them: bodies at
/// rest are hardly ever exactly parallel.
inline constexpr float kConeSlack = 0.173648178F;

/// Whether a unit direction lies among the outward normals of a corner, an edge or a face, that is in the cone that up
/// to three unit face normals span, or misses it by at most `kConeSlack`. A region's extreme point in any other
/// direction is no extreme of the body: it lies where the region ends and its neighbour begins.
bool isAmongNormals(std::span<const Vec3> faces, const Vec3& direction);

}  // namespace cairn::bullet
