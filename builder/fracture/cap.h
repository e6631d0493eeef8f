// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "fracture/half_space.h"

namespace cairn::builder {

/// A border's edge, from vertex to vertex.
using BorderEdge = std::array<std::uint32_t, 2>;

/// Fills the border that a plane has cut. The triangles use the border's vertices alone, face along the plane's normal
/// and close the rest of the solid. `border`: each edge in the direction of the cap's triangle; loops, holes in loops
/// and islands in holes. Fails when borders cross. Constrained Delaunay; O(n log n). The result has the same triangles
/// every time.
Result<std::vector<Triangle>> capOf(std::span<const Vec3d> vertices, std::span<const BorderEdge> border,
                                    const HalfSpace& plane);

}  // namespace cairn::builder
