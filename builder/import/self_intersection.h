// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// The first pair (lowest numbers) of triangles that have more in common than the vertices they share, decided with
/// exact predicates. Touching without a shared vertex counts. Precondition: indices in range, no degenerate triangle.
/// O(n log^2 n) for meshes whose triangles are of similar size.
std::optional<std::pair<std::uint32_t, std::uint32_t>> findSelfIntersection(const TriangleMesh& mesh);

/// The first pair of triangles, one of each mesh, that meet, touching included; vertices are never shared.
/// Preconditions and cost as above.
std::optional<std::pair<std::uint32_t, std::uint32_t>> findCrossing(const TriangleMesh& first,
                                                                    const TriangleMesh& second);

}  // namespace cairn::builder
