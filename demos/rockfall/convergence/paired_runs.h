// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "rockfall/convergence/convergence.h"

namespace cairn::rockfall {

/// The sums over a run's rocks of a quantity, at two steps.
struct PairedSums {
  double coarse = 0, fine = 0;
};

/// The mean difference over the mean at the fine step, and between which values 95 of a hundred means are of as many
/// runs drawn from these, with putting back. 0 where the fine step has nothing of the quantity. Cost: 2000 draws.
StepDifference differenceOf(std::span<const PairedSums> runs, std::uint64_t seed);

StepVerdict verdictOf(const StepDifference& difference, double tolerance);

/// How many runs would make the interval narrow enough to tell, which shrinks with the root of their number; 0 for what
/// no number would: a mean that lies on the tolerance.
std::uint64_t runsWanted(const StepDifference& difference, double tolerance, std::uint64_t runs);

}  // namespace cairn::rockfall
