// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"

namespace cairn::builder {

/// The Spawn construction (thesis 5.4, Alg. 7), which needs no medial axis. At one stand-off e every new ball starts
/// from the centre of an earlier one, or from an uncovered point when none can grow. Downhill simplex moves the ball
/// until it holds as many uncovered points as it can with the radius e + s(c). Bisection finds the least e that needs
/// no more than `problem.count` balls.
///
/// The result covers the points, often with fewer balls than requested. Cost: some 500 simplex searches of 40
/// evaluations, each with a distance query and a pass over the uncovered points.
SphereSet spawn(const CoverProblem& problem);

}  // namespace cairn::builder
