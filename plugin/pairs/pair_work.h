// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstdint>

#include "cairn/core/budget.h"
#include "cairn/core/scheduler.h"
#include "pairs/pair_estimate.h"

namespace cairn::bullet {

/// The cost of a pair's traversals, and its reservation.
struct PairWork {
  PairEstimate estimate;             ///< of this step, if it was estimated
  Reservation reserved;              ///< for finishing the pair
  bool wasDone = true;               ///< the traversal was done when a step last worked on it
  std::uint64_t spent = 0;           ///< operations of the present traversal
  std::uint64_t ofLastComplete = 0;  ///< operations of the last complete traversal

  /// Expected operations of the present traversal, or of the next one if the present one is done. An unfinished
  /// traversal expects at least one turn. `usual`: the recent cost of other pairs.
  std::uint64_t expected(std::uint64_t usual) const {
    const std::uint64_t whole = ofLastComplete > 0 ? ofLastComplete : usual;
    if (wasDone) return whole;
    return std::max<std::uint64_t>(std::max(whole, 2 * spent) - spent, Scheduler::kTurnOperations);
  }
  /// Forgets the costs; the reservation stays.
  void forget() { spent = ofLastComplete = 0; }
};

}  // namespace cairn::bullet
