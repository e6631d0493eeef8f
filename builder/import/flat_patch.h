// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Triangles over a polygon, each as three places in it, ascending: so they turn as the polygon does.
using Patch = std::vector<std::array<int, 3>>;

/// The constrained Delaunay triangulation of what the polygon is along its mean normal (Newell's). Empty where its
/// corners leave their plane by more than about `tolerance`, a length, and where it touches or crosses itself seen so.
/// CGAL's hole filling has such a step, but projects along a mean of normals that were turned to one side, which may
/// lie in the polygon's plane, and crashes on corners that then fall together. Three corners or more. n log n for most
/// polygons.
Patch flatPatch(std::span<const Vec3d> polygon, double tolerance);

}  // namespace cairn::builder
