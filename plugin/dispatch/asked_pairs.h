// SPDX-License-Identifier: Zlib
#pragma once

#include <atomic>
#include <vector>

#include "dispatch/step_tuning.h"
#include "memory/written_room.h"
#include "pairs/pair_prefetch.h"

namespace cairn::bullet {

/// The order in which Bullet asks about pairs, which hardly changes from step to step: what it asks next is fetched
/// ahead. In a large heap the states of all pairs are far more than any cache holds.
class AskedPairs {
 public:
  void reserve(std::size_t pairs) { makeWrittenRoom(asked_, pairs); }
  /// A step of so many pairs.
  void begin(std::size_t pairs) {
    asked_.resize(pairs);
    until_ = 0;
  }
  /// It asks about this one now. May be called from several threads.
  void ask(TreePair& pair, bool isEstimated) {
    using step_tuning::kCopiesAhead, step_tuning::kSubjectsAhead;
    const std::size_t at = until_++;
    if (at + kSubjectsAhead >= asked_.size()) return;
    // What one thread reads, another may have written.
    const auto asked = [&](std::size_t i) { return std::atomic_ref(asked_[i]); };
    const auto load = [&](std::size_t i) { return asked(i).load(std::memory_order_relaxed); };
    if (const TreePair* next = load(at + kSubjectsAhead)) prefetch(*next, PairPart::subject);
    if (const TreePair* next = load(at + kCopiesAhead))
      prefetch(*next, isEstimated ? PairPart::estimate : PairPart::copies);
    asked(at).store(&pair, std::memory_order_relaxed);
  }

 private:
  std::vector<TreePair*> asked_;  // up to `until_` as in this step, from there on as in the last
  std::atomic<std::size_t> until_{0};
};

}  // namespace cairn::bullet
