// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/convergence/paired_runs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/figures/random.h"

namespace cairn::rockfall {
namespace {

constexpr std::size_t kDraws = 2000;
constexpr double kOutside = 0.025;  // of the draws, on either side

double relative(const PairedSums& sums) {
  return sums.fine > 0 ? (sums.coarse - sums.fine) / sums.fine : 0;
}

}  // namespace

StepDifference differenceOf(std::span<const PairedSums> runs, std::uint64_t seed) {
  PairedSums all;
  for (const PairedSums& run : runs) all = {all.coarse + run.coarse, all.fine + run.fine};
  scenes::Random random(seed);
  std::vector<double> draws;
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    PairedSums drawn;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const PairedSums& run = runs[random.bits() % runs.size()];
      drawn = {drawn.coarse + run.coarse, drawn.fine + run.fine};
    }
    draws.push_back(relative(drawn));
  }
  std::ranges::sort(draws);
  const auto rank = static_cast<std::size_t>(kOutside * kDraws);
  // Of few runs draws are too alike: a sample's variance is (n - 1)/n of what it is drawn from.
  const double wider = std::sqrt(static_cast<double>(runs.size()) / static_cast<double>(runs.size() - 1));
  const double mean = relative(all);
  return {mean, mean + wider * (draws[rank] - mean), mean + wider * (draws[kDraws - 1 - rank] - mean)};
}

StepVerdict verdictOf(const StepDifference& difference, double tolerance) {
  if (difference.low >= -tolerance && difference.high <= tolerance) return StepVerdict::fine;
  if (difference.low > tolerance || difference.high < -tolerance) return StepVerdict::coarse;
  return StepVerdict::undecided;
}

std::uint64_t runsWanted(const StepDifference& difference, double tolerance, std::uint64_t runs) {
  const double half = (difference.high - difference.low) / 2, room = std::abs(tolerance - std::abs(difference.mean));
  constexpr double kTooFew = 0.05;  // of the tolerance: what is so near to it is not to be told apart
  if (room < kTooFew * tolerance) return 0;
  return std::max(runs,
                  static_cast<std::uint64_t>(std::ceil(static_cast<double>(runs) * (half / room) * (half / room))));
}

}  // namespace cairn::rockfall
