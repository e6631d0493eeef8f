// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "balls/sphere_set.h"

namespace cairn::builder {

/// The Burst reduction (thesis 5.3.2, Alg. 5): balls are removed one by one until `problem.count` are left. The points
/// of a removed ball go to the balls closest to covering them, each of which becomes the tighter of the smallest ball
/// around its points and its old centre with the radius needed. The removal that lowers the stand-offs involved most
/// goes first, else the one that leaves the smallest.
///
/// Precondition: `candidates` not empty. The result covers the points. With K candidates and N points K N words of
/// memory; the effects of removals are kept and only those evaluated again that a removal changed.
SphereSet burst(const CoverProblem& problem, std::span<const Ball> candidates);

}  // namespace cairn::builder
