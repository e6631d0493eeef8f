// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Returns the triangles of a body that lie within `distance` of another body and face it; where none faces it, all
/// within that distance. In order. Distances are rounded. O(n log^2 n) for triangles of similar size.
std::vector<std::uint32_t> trianglesNear(const TriangleMesh& body, const TriangleMesh& other, double distance);

/// Returns the triangles of a body that lie within `distance` of a triangle of another body and nearly in its plane,
/// but not exactly: planes that part by no more than the distance over the smaller triangle. In order. Cost as above.
std::vector<std::uint32_t> trianglesFlush(const TriangleMesh& body, const TriangleMesh& other, double distance);

}  // namespace cairn::builder
