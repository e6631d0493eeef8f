// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Returns the first pair (lowest numbers) of triangles whose intersection is more than their shared vertices. Exact
/// predicates decide. Contact without a shared vertex counts. Precondition: indices are in range, no triangle is
/// degenerate. O(n log^2 n) for meshes with triangles of similar size.
std::optional<std::pair<std::uint32_t, std::uint32_t>> findSelfIntersection(const TriangleMesh& mesh);

/// Returns all such pairs, in order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> findSelfIntersections(const TriangleMesh& mesh);

/// Returns the first pair of triangles, one of each mesh, that meet, contact included. The meshes never share vertices.
/// Preconditions and cost are those of `findSelfIntersection`.
std::optional<std::pair<std::uint32_t, std::uint32_t>> findCrossing(const TriangleMesh& first,
                                                                    const TriangleMesh& second);

}  // namespace cairn::builder
