// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Lowers the worst stand-off at which a set of balls covers the points: `optimiseLevel` for a level of one family.
/// Returns a set at least as good as `start`; rounds end when not even 2 % can be saved.
SphereSet optimise(const CoverProblem& problem, SphereSet start);

/// `optimise`, then tries to escape its local optimum: each ball in turn is taken away and set down again where the
/// cover is worst, and the set optimised anew; the first improvement is kept and the search begins again, `rounds`
/// times at most. About `problem.count` times the cost of `optimise` a round.
SphereSet optimiseBySwaps(const CoverProblem& problem, SphereSet start, int rounds);

}  // namespace cairn::builder
