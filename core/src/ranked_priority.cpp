// SPDX-License-Identifier: Zlib
#include "cairn/core/ranked_priority.h"

#include <algorithm>

namespace cairn {

void RankedPriority::begin(std::span<const ScheduledPair> pairs) {
  pairs_ = pairs;
  line_.begin(pairs);
  beginWeights(pairs);
  heap_.start(pairs.size());
  weights_.assign(pairs.size(), 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].traversal->done()) continue;
    weights_[i] = weight(pairs[i]);
    heap_.add(entryOf(i));
  }
}

// A pair with NaN (a body lost in the void) has no rank, but keeps its place in line.
RankHeap::Entry RankedPriority::entryOf(std::size_t pair) {
  const double rank = weights_[pair] * error(pairs_[pair]) * (1 + static_cast<double>(line_.age(pair)));
  return {rank > 0 ? rank : 0, line_.ticket(pair), pair};
}

double RankedPriority::error(const ScheduledPair& pair) {
  return static_cast<double>(std::max(pair.traversal->worstFrontError(), pair.unansweredError));
}

std::optional<std::size_t> RankedPriority::next() {
  if (line_.empty()) return std::nullopt;
  const bool isLinesTurn = turns_ % kTurnsToLine == kTurnsToLine - 1;
  return isLinesTurn ? line_.first() : heap_.top();
}

void RankedPriority::turnEnded(std::size_t pair, Progress progress) {
  ++turns_;
  line_.turnEnded(pair, progress);
  if (progress == Progress::done)
    heap_.remove(pair);
  else
    heap_.change(entryOf(pair));
}

}  // namespace cairn
