// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"
#include "cairn/builder/build.h"
#include "medial/candidates.h"

namespace cairn::builder {

/// Expand with the limits that suit `optimiser`. As in the thesis it sees all candidates and points. Where Cairn's
/// optimiser goes on from its set, a start from few of them serves as well.
SphereSet expandFor(Optimiser optimiser, const CoverProblem& problem, const Candidates& candidates);

/// The set of least stand-off of Merge's and Expand's (thesis 7.1.5). With Cairn's optimiser both are optimised first.
SphereSet betterOfBoth(Optimiser optimiser, const CoverProblem& problem, const Candidates& candidates);

}  // namespace cairn::builder
