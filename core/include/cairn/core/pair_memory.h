// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/priority.h"

namespace cairn {

/// A policy's records of pairs from one step to the next, found by id. Pairs that were not in a step are forgotten. A
/// new pair gets a default-constructed `Record`.
template <class Record>
class PairMemory {
 public:
  /// Afterwards there is one record for each of `pairs`, which ascend by id, in their order. Linear.
  void follow(std::span<const ScheduledPair> pairs) {
    lastStep_.swap(entries_);
    entries_.clear();
    entries_.reserve(pairs.size());
    auto known = lastStep_.begin();
    for (const ScheduledPair& pair : pairs) {
      while (known != lastStep_.end() && known->id < pair.id) ++known;
      const bool isKnown = known != lastStep_.end() && known->id == pair.id;
      entries_.push_back({pair.id, isKnown ? known->record : Record{}});
    }
  }

  /// The record of a pair, by its place in the list last followed.
  Record& operator[](std::size_t pair) { return entries_[pair].record; }
  /// The record of a pair, by its place in the list last followed.
  const Record& operator[](std::size_t pair) const { return entries_[pair].record; }

 private:
  struct Entry {
    std::uint64_t id;
    Record record;
  };
  std::vector<Entry> entries_, lastStep_;  // by id
};

}  // namespace cairn
