// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"

namespace cairn::builder {

/// The Grid construction (thesis 3.3, Alg. 1 and 2): balls around the cells of a cubic grid. Downhill simplex turns and
/// moves the grid freely, so that few balls hold all points. The cells start with the longest edge of the points'
/// oriented box and shrink by a tenth at a time, until more than `problem.count` cells are needed.
///
/// Of each size's cells, every ball then moves by itself to the least stand-off for its points (3.3, 6.1). Three times
/// the points are shared out anew among the moved balls, as the author's own program does. The result is the set with
/// the least worst stand-off. One ball would divide nothing, so it is returned only where no size gives more.
///
/// The result covers the points. Cost: some 12 searches of 200 evaluations, each linear in the points.
SphereSet gridSpheres(const CoverProblem& problem);

}  // namespace cairn::builder
