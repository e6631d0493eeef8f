// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::scenes {

/// Cuts a closed mesh into nearly convex parts with HACD (Mamou and Ghorbel 2009, from Bullet's extras). Returns the
/// corners of each part's hull. Together the hulls fill the mesh's concavities up to a tenth of its size. Takes seconds
/// for a thousand triangles. Fails in a build without HACD, and if HACD fails.
Result<std::vector<std::vector<Vec3d>>> convexParts(std::span<const Vec3d> vertices,
                                                    std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace cairn::scenes
