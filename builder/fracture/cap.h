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

/// Fills the border a plane has cut: triangles between its vertices alone, facing along the plane's normal, that close
/// what is left of the solid. `border`: each edge as the cap's triangle will go along it; loops, holes in them and
/// islands in these. Fails when borders cross. Constrained Delaunay; O(n log n). The same triangles every time.
Result<std::vector<Triangle>> capOf(std::span<const Vec3d> vertices, std::span<const BorderEdge> border,
                                    const HalfSpace& plane);

}  // namespace cairn::builder
