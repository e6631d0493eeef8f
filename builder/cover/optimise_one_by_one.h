// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Lowers the stand-offs of a set of balls by the thesis's method (6.2, Alg. 9 and 10). Ball after ball, the worst
/// first, downhill simplex searches a centre and a radius. The nearest other ball takes the points that the moved ball
/// loses. Points that the moved ball holds are free for the others, and those are fitted anew. The objective is ten
/// times the worst stand-off plus the root mean square (Eq. 6.1). Ends when a round saves less than 1 %.
///
/// Covers all points. The `coverStandOff` is never worse than that of `start`. Precondition: `start` is not empty. The
/// search sees 300 of the points. Each ball and round costs about 100 fits of the ball's neighbours. A pure function.
SphereSet optimiseOneByOne(const CoverProblem& problem, SphereSet start);

}  // namespace cairn::builder
