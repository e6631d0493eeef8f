// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstdint>

#include "cairn/core/budget.h"
#include "cairn/core/scheduler.h"
#include "pairs/pair_estimate.h"

namespace cairn::bullet {

/// What a pair's traversals take, and what is held back for it.
struct PairWork {
  PairEstimate estimate;             ///< of this step, if it was surveyed
  Reservation reserved;              ///< what is held back for finishing it
  bool wasDone = true;               ///< the traversal, when a step last ended in which something was done for it
  std::uint64_t spent = 0;           ///< operations, on the traversal at hand
  std::uint64_t ofLastComplete = 0;  ///< the same, of the last that ended

  /// Operations that are left to do, or that the next one takes: a turn at least of what is not done. `usual`: what
  /// others took lately.
  std::uint64_t expected(std::uint64_t usual) const {
    const std::uint64_t whole = ofLastComplete > 0 ? ofLastComplete : usual;
    if (wasDone) return whole;
    return std::max<std::uint64_t>(std::max(whole, 2 * spent) - spent, Scheduler::kTurnOperations);
  }
  /// As of a pair that nothing was done for; what is promised stays.
  void forget() { spent = ofLastComplete = 0; }
};

}  // namespace cairn::bullet
