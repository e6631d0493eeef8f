// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "balls/sphere_set.h"
#include "cairn/builder/expand_choices.h"

namespace cairn::builder {

/// How much of a problem `expand` looks at. As they stand the choice is a starting point for `optimise`, which sees all
/// points and moves centres freely: these many are enough for that, and the cost of max-elim is quadratic in the first.
struct ExpandLimits {
  std::size_t candidates = 150, points = 300;  ///< of max-elim
  int bisections = 10;                         ///< the stand-off then is known to 0.1 % of what one ball alone needs
};

/// The Expand reduction (thesis 5.3.3, Alg. 6): all candidates are grown to the same stand-off e, r = e + s(c), and a
/// greedy choice keeps as few as cover the points; the least e that needs no more than `problem.count` is found by
/// bisection. A choice that fails is tried again without its first ball. A single ball, which would
/// divide nothing, is replaced by the first larger set that does without balls which alone hold all points, where there
/// is one.
///
/// Max-elim works on evenly chosen candidates and evenly spread points, no more than the limits say, and costs with K
/// candidates and N points about 10 K^2 N / 64 word operations at worst; max-cover uses all of both at 10 K N. The
/// balls have radii r and hold those points. Precondition: `candidates` not empty.
SphereSet expand(const CoverProblem& problem, std::span<const Ball> candidates, ExpandRank rank = ExpandRank::maxElim,
                 const ExpandLimits& limits = {});

}  // namespace cairn::builder
