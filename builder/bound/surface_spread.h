// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Returns points of the mesh's surface, evenly spread. Each next point is the farthest from all before it (Gonzalez
/// 1985), so corners and tips come first. There are fewer than `count` only if there are fewer candidates. Mesh frame.
/// Each point lies within 64 units in the last place of the largest coordinate of the exact surface. Cost: `count` * C
/// distances, with C = about 8 `count` + 3 for each triangle. Once `keepGoing` returns false, it ends with those found
/// so far.
std::vector<Vec3d> spreadOverSurface(
    const TriangleMesh& mesh, std::size_t count, const KeepGoing& keepGoing = [] { return true; });

}  // namespace cairn::builder
