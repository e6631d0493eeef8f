// SPDX-License-Identifier: Zlib
#include <algorithm>
#include <limits>

#include "cairn/core/scheduler.h"

namespace cairn {

namespace {
constexpr std::size_t kFinished = std::numeric_limits<std::size_t>::max();
}

void RoundRobin::begin(std::span<const ScheduledPair> pairs) {
  pairs_ = pairs;
  cursor_ = 0;
  ring_.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!pairs[i].traversal->done()) ring_.push_back(i);
  // What is left of the round under way, then what it has served, then what came since it began.
  const auto firstAbove = [&](std::uint64_t id) {
    return std::find_if(ring_.begin(), ring_.end(), [&](std::size_t i) { return pairs[i].id > id; });
  };
  const auto unserved = firstAbove(lastServed_), fresh = firstAbove(roundEnd_);
  std::rotate(ring_.begin(), unserved, fresh);
}

std::optional<std::size_t> RoundRobin::next() {
  if (cursor_ == ring_.size()) {
    std::erase(ring_, kFinished);
    cursor_ = 0;
  }
  if (ring_.empty()) return std::nullopt;
  return ring_[cursor_];
}

void RoundRobin::turnEnded(std::size_t pair, Progress progress) {
  const std::uint64_t id = pairs_[pair].id;
  if (id <= lastServed_ || id > roundEnd_) roundEnd_ = pairs_.back().id;  // a new round
  lastServed_ = id;
  if (progress == Progress::done) ring_[cursor_] = kFinished;
  ++cursor_;
}

}  // namespace cairn
