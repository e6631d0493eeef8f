// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "rockfall/validation/comparison.h"

namespace cairn::rockfall {

/// One set of values that calibration tried.
struct Trial {
  std::uint32_t round = 0;
  std::vector<double> values;  ///< in the parameters' order
  double misfit = 0;
};

struct Calibration {
  std::vector<Trial> trials;  ///< in the order they were tried; the first is what the settings had
  std::size_t best = 0;
  std::uint32_t blocks = 0;  ///< that each let go
};

/// What calibration makes small: for run-out and for lateral spread the distance by which the stops must be moved to be
/// the measured ones (Wasserstein), over the measured middle half's width; both together.
double misfitOf(const Stops& simulated, const Stops& measured);

/// Looks for better values of the settings' parameters on profile P1, and on it alone: the first round draws candidates
/// from the whole ranges, each further one from boxes a third as wide about the best so far, within the ranges. All let
/// the same blocks go, drawn once. A pure function of data and settings. Fails without measured stops on P1, and as
/// `simulateBlocks` does. Cost: candidates x rounds x blocks runs.
Result<Calibration> calibrate(QuarryScene& quarry, const ValidationSettings& settings, std::uint32_t jobs,
                              const ShareDone& progress = {});

}  // namespace cairn::rockfall
