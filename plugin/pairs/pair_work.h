// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/core/budget.h"
#include "pairs/pair_need.h"

namespace cairn::bullet {

/// What a pair's traversals take, and what is held back for it.
struct PairWork {
  PairNeed need;                  ///< of this step, if it was surveyed
  Promise promised;               ///< what is held back for finishing it
  bool wasDone = true;            ///< the traversal, when a step last ended in which something was done for it
  std::uint64_t spent = 0;        ///< operations, on the traversal at hand
  std::uint64_t ofLastWhole = 0;  ///< the same, of the last that ended

  /// Operations of the next. `usual`: what others took lately.
  std::uint64_t expected(std::uint64_t usual) const;
  /// As of a pair that nothing was done for; what is promised stays.
  void forget() { spent = ofLastWhole = 0; }
};

}  // namespace cairn::bullet
