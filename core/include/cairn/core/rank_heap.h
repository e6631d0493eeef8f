// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/core/export.h"

namespace cairn {

/// The pairs of a step by rank, greatest first; of equal ranks the smaller ticket. A binary heap that knows where each
/// pair is, so that the rank of one can change. O(log n) a change.
class CAIRN_CORE_EXPORT RankHeap {
 public:
  /// A pair with its rank.
  struct Entry {
    double rank = 0;           ///< not NaN
    std::uint64_t ticket = 0;  ///< the smaller goes first where ranks are equal
    std::size_t pair = 0;      ///< its place in the step's list
  };

  /// Empties the heap, for pairs numbered below `count`.
  void start(std::size_t count);
  /// Precondition: the entry's pair is not in the heap.
  void add(const Entry& entry);
  /// Precondition: the entry's pair is in the heap.
  void change(const Entry& entry);
  /// Precondition: `pair` is in the heap.
  void remove(std::size_t pair);
  /// Precondition: not empty.
  std::size_t top() const { return entries_.front().pair; }
  /// Whether no pair is in the heap.
  bool empty() const { return entries_.empty(); }

 private:
  void settle(std::size_t place, const Entry& entry);
  void put(std::size_t place, const Entry& entry);

  std::vector<Entry> entries_;
  std::vector<std::size_t> place_;  // in entries_, by pair
};

}  // namespace cairn
