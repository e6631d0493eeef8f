// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/pair_list.h"
#include "cairn/core/pose.h"
#include "cairn/core/traversal.h"

namespace cairn {

/// One of the two trees of a staircase traversal, as the inner loop wants it.
struct StaircaseBody {
  const Family* families = nullptr;
  const TraversalNode* nodes = nullptr;
  Similarity fromOther;  ///< from the other tree's frame into this one's
  float scale = 1;       ///< world length per tree unit
  float margin = 0;      ///< in tree units, with the rounding slack
};

/// The pairs of a traversal: [0, head) of the queue has been refined.
struct StaircasePairs {
  PairList& queue;
  std::size_t& head;
  PairList& leafPairs;
};

/// Refines the oldest pairs of the queue until there are none or the budget refuses one. The whole loop runs inside one
/// dispatched function; the same bits on every instruction set.
Progress refineStaircase(const StaircaseBody& a, const StaircaseBody& b, StaircasePairs pairs, Budget& budget);

}  // namespace cairn
