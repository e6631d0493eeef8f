// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "balls/point_set.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// Random points of the layer outside a solid up to `reach` from it, about `count`, each for the same volume: one in
/// each cell of a cubic grid. Deterministic. About two distance queries for each point, and some for empty cells.
PointSet outsideSamples(const SignedDistance& solid, double reach, std::size_t count, std::uint64_t seed);

}  // namespace cairn::builder
