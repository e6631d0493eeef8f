// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Moves vertices so that the planes of `raised` triangles move outward by `amount` and no plane moves inward; others
/// stay where that is possible. A vertex moves by the shortest way, and never farther than eight amounts: at a needle's
/// point that may not suffice. Precondition: triangle numbers are in order.
void raiseFaces(TriangleMesh& mesh, const std::vector<std::uint32_t>& raised, double amount);

}  // namespace cairn::builder
