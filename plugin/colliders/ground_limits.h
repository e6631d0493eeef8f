// SPDX-License-Identifier: Zlib
// What grounds of triangles share: meshes and terrains.
#pragma once

#include <cstdint>

namespace cairn::bullet {

// Directions in which the whole tree is held.
constexpr std::uint32_t kMaxRootContacts = 4;
// Fraction of the root's radius by which a triangle must stand before the plane of a nearer one to count beside it.
constexpr float kCoveredFraction = 0.01F;

}  // namespace cairn::bullet
