// SPDX-License-Identifier: Zlib
#pragma once

#include <atomic>
#include <vector>

#include "dispatch/step_tuning.h"
#include "memory/written_room.h"
#include "pairs/pair_prefetch.h"

namespace cairn::bullet {

/// The order in which Bullet asks about pairs, which hardly changes from step to step. It tells which pairs to
/// prefetch: in a large heap all pairs together exceed any cache.
class AskedPairs {
 public:
  void reserve(std::size_t pairs) { makeWrittenRoom(asked_, pairs); }
  /// Begins a step of this many pairs.
  void begin(std::size_t pairs) {
    asked_.resize(pairs);
    until_ = 0;
  }
  /// Bullet asks about this pair now. May be called from several threads.
  void ask(TreePair& pair, bool isEstimated) {
    using step_tuning::kCopiesAhead, step_tuning::kSubjectsAhead;
    const std::size_t at = until_++;
    if (at + kSubjectsAhead >= asked_.size()) return;
    // Atomic, because another thread may write the entry.
    const auto load = [&](std::size_t i) { return asked_[i].pair.load(std::memory_order_relaxed); };
    if (const TreePair* next = load(at + kSubjectsAhead)) prefetch(*next, PairPart::subject);
    if (const TreePair* next = load(at + kCopiesAhead))
      prefetch(*next, isEstimated ? PairPart::estimate : PairPart::copies);
    asked_[at].pair.store(&pair, std::memory_order_relaxed);
  }

 private:
  // Is copied only where a list grows, when no thread asks.
  struct Asked {
    Asked() = default;
    Asked(const Asked& other) : pair(other.pair.load(std::memory_order_relaxed)) {}
    Asked& operator=(const Asked&) = delete;

    std::atomic<TreePair*> pair{nullptr};
  };

  std::vector<Asked> asked_;  // this step's order up to `until_`, the last step's beyond
  std::atomic<std::size_t> until_{0};
};

}  // namespace cairn::bullet
