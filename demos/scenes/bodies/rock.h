// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::scenes {

struct RockOptions {
  std::uint64_t seed = 1;
  /// Times each triangle of an icosahedron is quartered: 20 * 4^n triangles. 1..6.
  std::uint32_t subdivisions = 3;
};

/// A concave rock about 1 unit across: an icosphere with seeded fracture planes, dents and roughness, its vertices
/// moved along their own rays from the centre. That keeps the surface star-shaped, so it is closed, manifold, outward
/// and free of self-intersections by construction; the dents, at least two, make it concave. Equal options give equal
/// bits.
builder::TriangleMesh generateRock(const RockOptions& options);

}  // namespace cairn::scenes
