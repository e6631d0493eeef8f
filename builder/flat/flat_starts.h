// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "flat/flat_problem.h"

namespace cairn::builder {

/// Sets to begin a search from, made in as many ways as there are methods for whole solids: grown from one ball, from
/// random first balls, medial balls merged and expanded, and the level of a `combined` tree that comes nearest. None
/// has more than `count` balls. Depths are the solid's. Deterministic, parallel. Empty when cancelled.
std::vector<SphereSet> flatStarts(const FlatProblem& problem, const FlatPoints& points);

}  // namespace cairn::builder
