// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Triangles over a polygon. Each is three ascending positions in it, so the triangles turn like the polygon.
using Patch = std::vector<std::array<int, 3>>;

/// Returns the constrained Delaunay triangulation of the polygon's projection along its mean normal (Newell's). Empty
/// when its corners leave their plane by more than about `tolerance` (a length), and when the projection touches or
/// crosses itself.
///
/// CGAL's hole filling has such a step, but projects along a mean of normals that were turned to one side. That mean
/// may lie in the polygon's plane. The step then crashes on corners that coincide. Precondition: at least three
/// corners. O(n log n) for most polygons.
Patch flatPatch(std::span<const Vec3d> polygon, double tolerance);

}  // namespace cairn::builder
