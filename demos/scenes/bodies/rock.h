// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::scenes {

struct RockOptions {
  std::uint64_t seed = 1;
  /// How often each triangle of an icosahedron is split in four: 20 * 4^n triangles. 1..6.
  std::uint32_t subdivisions = 3;
};

/// Generates a concave rock about 1 unit across: an icosphere with seeded fracture planes, dents and roughness.
/// Vertices move only along their rays from the centre, so the surface stays star-shaped. It is therefore closed,
/// manifold, outward and free of self-intersections by construction. At least two dents make it concave. Equal options
/// give equal bits.
builder::TriangleMesh generateRock(const RockOptions& options);

}  // namespace cairn::scenes
