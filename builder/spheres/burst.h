// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "balls/sphere_set.h"

namespace cairn::builder {

/// The Burst reduction (thesis 5.3.2, Alg. 5): balls are removed one by one until `problem.count` are left. The points
/// of a removed ball go to the balls that need to grow least for them. Each of these becomes the tighter of two balls:
/// the smallest ball around its points, and its old centre with the radius needed. The removal that lowers the affected
/// stand-offs most goes first. Without such a removal, the one that leaves the smallest stand-offs goes first.
///
/// Precondition: `candidates` is not empty. The result covers the points. With K candidates and N points it needs K N
/// words of memory. The effects of removals are cached; only effects that a removal changed are evaluated again.
SphereSet burst(const CoverProblem& problem, std::span<const Ball> candidates);

}  // namespace cairn::builder
