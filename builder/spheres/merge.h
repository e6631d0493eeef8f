// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "balls/sphere_set.h"

namespace cairn::builder {

/// The improved merge (thesis 5.3.1). Every point starts in the medial sphere that holds it most cheaply. Pairs of
/// balls are replaced by one ball around the points of both, until `problem.count` are left. The pair with the smallest
/// resulting stand-off goes first. A merge that improves the worst ball goes before all others. The new ball is the
/// tightest of the smallest enclosing ball and the two old centres.
///
/// Pairs are balls whose regions touch: the two cheapest balls of some point. A ball without such a neighbour gets
/// those it overlaps, or else all. Once 2.5 times the count are left, all pairs compete. Preconditions: `candidates` is
/// not empty; the points have depth 0 in `problem.solid`. Cost: some 10 evaluations (a smallest enclosing ball and a
/// distance query) for each candidate.
SphereSet merge(const CoverProblem& problem, std::span<const Ball> candidates);

}  // namespace cairn::builder
