// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/pair_memory.h"
#include "cairn/core/priority.h"

namespace cairn {

/// The unfinished pairs in the order of their last turns, over all steps: who has waited longest is first.
///
/// Nobody is ever put in front of another, so the k-th in line is first after k turns of whoever was first before it.
class CAIRN_CORE_EXPORT WaitingLine {
 public:
  /// A new step; `pairs` ascend by id. Who is new, or had nothing to wait for, stands behind all others, by id.
  /// O(n log n) for n pairs.
  void begin(std::span<const ScheduledPair> pairs);

  /// Whether nobody is in line.
  bool empty() const { return next_.empty() || next_.back() == next_.size() - 1; }
  /// Index of the pair that has waited longest. Precondition: not empty.
  std::size_t first() const { return next_.back(); }
  /// Who has had a turn goes to the end, or leaves when it is done. Precondition: it is in line.
  void turnEnded(std::size_t pair, Progress progress);

  /// The smaller, the longer the pair has waited; no two are equal. For a pair in line.
  std::uint64_t ticket(std::size_t pair) const { return records_[pair].ticket; }
  /// Whole steps that went by without a turn for the pair; 1 for one that has never had any.
  std::uint64_t age(std::size_t pair) const;

 private:
  struct Record {
    std::uint64_t ticket = 0;        // 0: none yet
    std::uint64_t waitingSince = 0;  // the last step that left it nothing to wait for
  };
  void append(std::size_t pair);

  PairMemory<Record> records_;
  std::uint64_t step_ = 1;
  std::uint64_t nextTicket_ = 1;
  std::vector<std::size_t> next_, previous_;  // a ring of those in line, closed by one more than there are pairs
  std::vector<std::size_t> order_;            // room to sort them
};

}  // namespace cairn
