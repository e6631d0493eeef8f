// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "evaluate/cut_ball.h"

namespace cairn::builder {

/// Share of the mesh's area that lies in none of the balls (thesis 7.1.1): systematic sampling along the triangles by
/// area, one random point in each of 100 000 strata, so that the standard error is below sqrt(share / 100 000). 0 means
/// no sample was outside; the proof is `certify`'s.
double uncoveredAreaFraction(const TriangleMesh& mesh, const std::vector<CutBall>& balls, std::uint64_t seed);

}  // namespace cairn::builder
