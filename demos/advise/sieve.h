// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "advise/advice.h"

namespace cairn::advise {

/// As many trees as are played as often as they may be, whatever the sieve says.
inline constexpr std::size_t kFinalists = 3;
/// While trees are sieved, what takes up to this times the budget counts as within it: few playings are not sure.
inline constexpr double kSieveSlack = 1.25;

/// The better half of those still running (places in `candidates`), rounded up, at least `kFinalists`, in their order:
/// first by the lowest mean error they reach within `kSieveSlack` times the budget; those that reach nothing within it
/// come after all others, the cheapest first. Precondition: every candidate has a rung.
std::vector<std::size_t> betterHalf(const std::vector<Candidate>& candidates, const std::vector<std::size_t>& running,
                                    double budgetUs);

}  // namespace cairn::advise
