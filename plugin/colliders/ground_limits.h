// SPDX-License-Identifier: Zlib
// Limits shared by colliders of triangles: meshes and terrains.
#pragma once

#include <cstdint>

namespace cairn::bullet {

// Directions in which the whole tree is held.
constexpr std::uint32_t kMaxRootContacts = 4;
// Fraction of the root's radius. A triangle must rise above the plane of a nearer one by this much to count beside it.
constexpr float kCoveredFraction = 0.01F;

}  // namespace cairn::bullet
