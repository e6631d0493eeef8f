// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Lowers the worst stand-off of a set of balls that covers the points: `optimiseLevel` for a level of one family.
/// Returns a set at least as good as `start`. Rounds end when they cannot save 2 %.
SphereSet optimise(const CoverProblem& problem, SphereSet start);

/// Calls `optimise`, then tries to escape its local optimum. Each ball in turn is removed and placed where the cover is
/// worst, and the set is optimised anew. The first improvement is kept and the search begins again, at most `rounds`
/// times. A round costs about `problem.count` times as much as `optimise`.
SphereSet optimiseBySwaps(const CoverProblem& problem, SphereSet start, int rounds);

}  // namespace cairn::builder
