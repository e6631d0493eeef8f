// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flat/minimax_cover.h"
#include "flat/mirror.h"

namespace cairn::builder {

/// `minimaxCover` for a body with a mirror plane (body's frame), by a set that has it too: pairs, each ball followed by
/// its image, then balls on the plane; exactly `count` in all. Searched among several numbers of balls on the plane.
/// The surface is folded to one side, where a pair is one ball and a ball on the plane is held there. Deterministic.
/// Empty when cancelled.
FlatSet mirroredCover(const FlatProblem& problem, const FlatPoints& points, DepthOf depthOf, const Mirror& mirror);

/// Gives both balls of the first `pairs` pairs one radius and exactly mirrored centres; `choose` makes one radius of
/// two.
SphereSet evenPairs(SphereSet balls, std::size_t pairs, const Mirror& mirror, double (*choose)(double, double));

}  // namespace cairn::builder
