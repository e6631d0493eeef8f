// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "balls/sphere_set.h"
#include "cairn/builder/expand_choices.h"

namespace cairn::builder {

/// Limits on the part of a problem that `expand` examines. The defaults suffice for a starting point of `optimise`,
/// which sees all points and moves centres freely. The cost of max-elim is quadratic in `candidates`.
struct ExpandLimits {
  std::size_t candidates = 150, points = 300;  ///< for max-elim
  int bisections = 10;  ///< gives the stand-off to 0.1 % of the stand-off that one ball alone needs
};

/// Every candidate and point, and the stand-off to a millionth: Expand as the thesis has it.
inline constexpr ExpandLimits kNoExpandLimits{~std::size_t{0}, ~std::size_t{0}, 20};

/// The Expand reduction (thesis 5.3.3, Alg. 6). All candidates grow to the same stand-off e, r = e + s(c). A greedy
/// choice keeps as few as cover the points. Bisection finds the least e that needs no more than `problem.count` balls.
/// A choice that fails is tried again without its first ball. A single ball would divide nothing. It is replaced by the
/// first larger set without balls that alone hold all points, if there is one.
///
/// Max-elim uses evenly chosen candidates and evenly spread points, no more than the limits say. With K candidates and
/// N points it costs at most about 10 K^2 N / 64 word operations. Max-cover uses all candidates and points at a cost of
/// 10 K N. The balls have radii r and hold those points. Precondition: `candidates` is not empty.
SphereSet expand(const CoverProblem& problem, std::span<const Ball> candidates, ExpandRank rank = ExpandRank::maxElim,
                 const ExpandLimits& limits = {});

}  // namespace cairn::builder
