// SPDX-License-Identifier: GPL-3.0-or-later
#include "advise/sieve.h"

#include <algorithm>
#include <utility>

namespace cairn::advise {
namespace {

/// Lower is better.
std::pair<int, double> rankOf(const Candidate& candidate, double budgetUs) {
  if (const auto rung = bestRung(candidate, kSieveSlack * budgetUs)) return {0, candidate.rungs[*rung].meanError};
  return {1, candidate.rungs[cheapestChoice({candidate}).rung].p99Us};
}

}  // namespace

std::vector<std::size_t> betterHalf(const std::vector<Candidate>& candidates, const std::vector<std::size_t>& running,
                                    double budgetUs) {
  std::vector<std::size_t> better = running;
  std::ranges::stable_sort(better, {}, [&](std::size_t i) { return rankOf(candidates[i], budgetUs); });
  better.resize(std::min(better.size(), std::max(kFinalists, (running.size() + 1) / 2)));
  std::ranges::sort(better);
  return better;
}

}  // namespace cairn::advise
