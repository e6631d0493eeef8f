// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Points of the mesh's surface, evenly spread: each next one is the farthest from all before it (Gonzalez 1985), so
/// that corners and tips come first. Fewer than `count` only if there are fewer candidates. Mesh frame; within 64 units
/// in the last place of the largest coordinate of the exact surface. With C candidates, about 8 `count` and three for
/// each triangle, `count` * C distances.
std::vector<Vec3d> spreadOverSurface(const TriangleMesh& mesh, std::size_t count);

}  // namespace cairn::builder
