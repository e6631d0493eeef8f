// SPDX-License-Identifier: Zlib
#include "cairn/core/scheduler.h"

#include <algorithm>
#include <optional>

namespace cairn {

namespace {

// The result of a pair's turn; `budgetSpent` also when no turn was possible. `used`: operations.
struct Turn {
  Progress progress = Progress::budgetSpent;
  std::uint64_t used = 0;
};

Turn giveTurn(std::span<const ScheduledPair> pairs, std::size_t pair, Budget& budget, TurnListener* listener,
              std::uint64_t operations = Scheduler::kTurnOperations) {
  if (!budget.charge(0)) return {};
  Budget turn = Budget::operations(std::min(operations, budget.remaining()));
  const Progress progress = pairs[pair].traversal->refine(turn);
  budget.forceCharge(turn.used());
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

void Scheduler::shareOut(std::span<const ScheduledPair> pairs, std::span<const std::size_t> chosen,
                         std::uint64_t operations, Budget& budget, TurnListener* listener) {
  const auto isUnfinished = [&](std::size_t pair) { return !pairs[pair].traversal->done(); };
  for (std::uint64_t used = kStepOperations; used > 0;) {
    const auto unfinished = static_cast<std::uint64_t>(std::ranges::count_if(chosen, isUnfinished));
    if (unfinished == 0) return;
    const std::uint64_t each = std::clamp<std::uint64_t>(operations / unfinished, kStepOperations, kTurnOperations);
    used = 0;
    for (const std::size_t pair : chosen) {
      if (operations < kStepOperations) return;
      if (!isUnfinished(pair)) continue;
      const std::uint64_t taken = giveTurn(pairs, pair, budget, listener, std::min(each, operations)).used;
      operations -= taken;
      used += taken;
    }
  }
}

Progress Scheduler::runAlone(std::span<const ScheduledPair> pairs, std::size_t pair, Budget& budget,
                             TurnListener* listener) {
  for (;;) {
    const Turn turn = giveTurn(pairs, pair, budget, listener);
    if (turn.progress == Progress::done || turn.used == 0) return turn.progress;
  }
}

}  // namespace cairn
