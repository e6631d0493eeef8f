// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::accuracy_cost {

/// The simple solids of the thesis's chapter 7, closed and facing outward. The thesis gives no sizes, so they are our
/// choice.

/// A box with these edges, two triangles for each face.
builder::TriangleMesh box(const Vec3d& edges);
/// Axis z, radius 1, flat ends.
builder::TriangleMesh cylinder(double height, std::uint32_t sides);
/// Axis z, radius 1 at z = 0, apex above.
builder::TriangleMesh cone(double height, std::uint32_t sides);
/// Axis z; `minor` < `major`.
builder::TriangleMesh torus(double major, double minor, std::uint32_t around, std::uint32_t across);
/// A round tube of radius 0.35 and 16 sides with flat ends. It follows two arcs of 225 degrees and radius 1 that bend
/// opposite ways. It replaces the thesis's S of NURBS surfaces.
builder::TriangleMesh sShape();

}  // namespace cairn::accuracy_cost
