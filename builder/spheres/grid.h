// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"

namespace cairn::builder {

/// The Grid construction (thesis 3.3, Alg. 1 and 2): balls around the cells of a cubic grid. Downhill simplex turns and
/// moves the grid freely, so that few balls hold all points. The cells start with the longest edge of the points'
/// oriented box and shrink by a tenth at a time. The search ends when more than `problem.count` cells were needed four
/// times. A ball becomes the smallest one around the points it was kept for. The result is the set with the least worst
/// stand-off.
///
/// The result covers the points. Cost: some 20 searches of 120 evaluations, each linear in at most 200 of the points.
SphereSet gridSpheres(const CoverProblem& problem);

}  // namespace cairn::builder
