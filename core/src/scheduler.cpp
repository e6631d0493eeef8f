// SPDX-License-Identifier: Zlib
#include "cairn/core/scheduler.h"

#include <algorithm>
#include <optional>

namespace cairn {

Progress Scheduler::run(std::span<ScheduledPair> pairs, Priority& priority, Budget& budget, TurnListener* listener) {
  std::sort(pairs.begin(), pairs.end(), [](const auto& l, const auto& r) { return l.id < r.id; });
  priority.begin(pairs);
  while (const std::optional<std::size_t> pair = priority.next()) {
    if (!budget.charge(0)) return Progress::budgetSpent;
    Budget turn = Budget::operations(std::min<std::uint64_t>(kTurnOperations, budget.remaining()));
    const Progress progress = pairs[*pair].traversal->refine(turn);
    budget.chargeAnyway(turn.used());
    if (listener) listener->turnEnded(*pair, progress, budget);
    // A turn holds any single step, so one that could do nothing means that the whole budget is too small for the next
    // step.
    if (progress == Progress::budgetSpent && turn.used() == 0) return Progress::budgetSpent;
    priority.turnEnded(*pair, progress);
  }
  return Progress::done;
}

}  // namespace cairn
