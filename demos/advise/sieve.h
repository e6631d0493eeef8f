// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "advise/advice.h"

namespace cairn::advise {

/// This number of trees always gets the full number of plays.
inline constexpr std::size_t kFinalists = 3;
/// During the sieve, times up to this factor of the budget count as within it, because few plays are uncertain.
inline constexpr double kSieveSlack = 1.25;

/// Returns the better half of the trees in `running` (indices into `candidates`), rounded up, at least `kFinalists`, in
/// their order. Trees are ranked by the lowest mean error within `kSieveSlack` times the budget. Trees without any
/// result within it come last, the cheapest first. Precondition: every candidate has a rung.
std::vector<std::size_t> betterHalf(const std::vector<Candidate>& candidates, const std::vector<std::size_t>& running,
                                    double budgetUs);

}  // namespace cairn::advise
