// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "spheres/sphere_set.h"

namespace cairn::builder {

/// Lowers the worst stand-off at which a set of balls covers the points, by moving their centres (the purpose of thesis
/// Alg. 9; the method is ours). Returns a set at least as good as `start`, radii as needed for the points each ball
/// holds most cheaply.
///
/// A round asks for a stand-off somewhat below the present worst. Ball by ball, worst first, a centre is moved downhill
/// for the points that are the ball's own duty: those no other ball holds at that stand-off. Points that another ball
/// holds as well are free, which lets the error spread over the whole set as in Expand, without a fixed list of
/// candidates. A ball without any duty is moved to where the worst ball is. Rounds end when not even 2 % can be saved.
SphereSet optimise(const CoverProblem& problem, SphereSet start);

/// `optimise`, then tries to escape its local optimum: each ball in turn is taken away and set down again where the
/// cover is worst, and the set optimised anew; the first improvement is kept and the search begins again, `rounds`
/// times at most. About `problem.count` times the cost of `optimise` a round.
SphereSet optimiseBySwaps(const CoverProblem& problem, SphereSet start, int rounds);

}  // namespace cairn::builder
