// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"

namespace cairn::builder {

/// The Grid construction (thesis 3.3, Alg. 1 and 2): balls around the cells of a cubic grid that is turned and moved
/// freely, by downhill simplex, so that few of them hold all points; the cells shrink by a tenth at a time from the
/// longest edge of the points' oriented box until more than `problem.count` were needed four times. A ball becomes the
/// smallest one around the points it was kept for, and the set of the least worst stand-off is the result.
///
/// The result covers the points. Some 20 searches of 120 evaluations, each linear in at most 200 of the points.
SphereSet gridSpheres(const CoverProblem& problem);

}  // namespace cairn::builder
