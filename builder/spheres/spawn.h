// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"

namespace cairn::builder {

/// The Spawn construction (thesis 5.4, Alg. 7), which needs no medial axis: at one stand-off e every new ball starts
/// from the centre of one already there, or from an uncovered point when none can grow, and is moved by downhill
/// simplex until it holds as many uncovered points as it can with the radius e + s(c). The least e that needs no more
/// than `problem.count` balls is found by bisection.
///
/// The result covers the points; often with fewer balls than asked for. Some 500 simplex searches of 40 evaluations,
/// each a distance query and a pass over the uncovered points.
SphereSet spawn(const CoverProblem& problem);

}  // namespace cairn::builder
