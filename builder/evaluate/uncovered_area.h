// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "evaluate/cut_ball.h"

namespace cairn::builder {

/// Returns the share of the mesh's area that lies in none of the balls (thesis 7.1.1). Systematic sampling takes one
/// random point in each of 100 000 strata along the triangles, by area. So the standard error is below sqrt(share / 100
/// 000). 0 means that no sample was outside; only `certify` proves cover. The same seed gives the same bits.
double uncoveredAreaFraction(const TriangleMesh& mesh, const std::vector<CutBall>& balls, std::uint64_t seed);

}  // namespace cairn::builder
