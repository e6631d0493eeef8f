// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Lowers the stand-offs of a set of balls as the thesis does (6.2, Alg. 9 and 10): ball after ball, the worst first,
/// centre and radius are searched by downhill simplex. Points the moved ball lets go of are taken by the nearest other
/// one, points it holds are free for the others, and those are fitted anew; what is lowered is ten times the worst
/// stand-off plus the root of the mean square (Eq. 6.1). Ends when a round saves less than 1 %.
///
/// Covers all points; never a worse `coverStandOff` than `start`, which must not be empty. The search sees 300 of the
/// points. About 100 fits of each ball's neighbours for each ball and round. A pure function.
SphereSet optimiseOneByOne(const CoverProblem& problem, SphereSet start);

}  // namespace cairn::builder
