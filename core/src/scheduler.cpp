// SPDX-License-Identifier: Zlib
#include "cairn/core/scheduler.h"

#include <algorithm>
#include <optional>

namespace cairn {

namespace {

// What a pair's turn came to; `budgetSpent` as well when there could be none. `used`: operations.
struct Turn {
  Progress progress = Progress::budgetSpent;
  std::uint64_t used = 0;
};

Turn giveTurn(std::span<const ScheduledPair> pairs, std::size_t pair, Budget& budget, TurnListener* listener) {
  if (!budget.charge(0)) return {};
  Budget turn = Budget::operations(std::min<std::uint64_t>(Scheduler::kTurnOperations, budget.remaining()));
  const Progress progress = pairs[pair].traversal->refine(turn);
  budget.chargeAnyway(turn.used());
  if (listener) listener->turnEnded(pair, progress, budget);
  return {progress, turn.used()};
}

}  // namespace

Progress Scheduler::run(std::span<ScheduledPair> pairs, Priority& priority, Budget& budget, TurnListener* listener) {
  std::sort(pairs.begin(), pairs.end(), [](const auto& l, const auto& r) { return l.id < r.id; });
  priority.begin(pairs);
  while (const std::optional<std::size_t> pair = priority.next()) {
    const Turn turn = giveTurn(pairs, *pair, budget, listener);
    // A turn holds any single step, so one that could do nothing means that the whole budget is too small for the next
    // step.
    if (turn.progress == Progress::budgetSpent && turn.used == 0) return Progress::budgetSpent;
    priority.turnEnded(*pair, turn.progress);
  }
  return Progress::done;
}

Progress Scheduler::runAlone(std::span<const ScheduledPair> pairs, std::size_t pair, Budget& budget,
                             TurnListener* listener) {
  for (;;) {
    const Turn turn = giveTurn(pairs, pair, budget, listener);
    if (turn.progress == Progress::done || turn.used == 0) return turn.progress;
  }
}

}  // namespace cairn
