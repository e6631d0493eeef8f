// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "spheres/sphere_set.h"

namespace cairn::builder {

/// Which candidate the greedy choice of Expand takes next (thesis 5.3.3).
enum class ExpandRank {
  maxElim,   ///< the one that makes most others redundant, then the one that covers most
  maxCover,  ///< the one that covers most of what is uncovered (Alg. 6 as listed)
};

/// The Expand reduction (thesis 5.3.3, Alg. 6): all candidates are grown to the same stand-off e, r = e + s(c), and a
/// greedy choice keeps as few as cover the points; the least e that needs no more than `problem.count` is found by
/// bisection. A choice that fails is tried again without its first ball. A single ball, which would divide nothing, is
/// replaced by the first larger set that does without balls which alone hold all points, where there is one.
///
/// Max-elim works on at most 150 evenly chosen candidates and 300 evenly spread points, and costs with K candidates and
/// N points about 10 K^2 N / 64 word operations at worst; max-cover uses all of both at 10 K N. The balls have radii r
/// and hold those points. Precondition: `candidates` not empty.
SphereSet expand(const CoverProblem& problem, std::span<const Ball> candidates, ExpandRank rank = ExpandRank::maxElim);

}  // namespace cairn::builder
