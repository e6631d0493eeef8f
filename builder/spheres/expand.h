// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "spheres/sphere_set.h"

namespace cairn::builder {

/// The Expand reduction (thesis 5.3.3, Alg. 6): all candidates are grown to the same stand-off e, r = e + s(c), and a
/// greedy choice keeps as few as cover the points, preferring the candidate that makes most others redundant
/// (max-elim), then the one that covers most; the least e that needs no more than `problem.count` is found by
/// bisection.
///
/// Works on at most 150 evenly chosen candidates and 300 evenly spread points; the balls have radii r and hold those
/// points. Precondition: `candidates` not empty. With K candidates and N points about 10 K^2 N / 64 word operations at
/// worst.
SphereSet expand(const CoverProblem& problem, std::span<const Ball> candidates);

}  // namespace cairn::builder
