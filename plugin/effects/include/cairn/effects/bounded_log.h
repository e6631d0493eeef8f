// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/core/export.h"

namespace cairn::effects {

/// A log of events until somebody takes them. It has room for a fixed number of entries; when it is full, the oldest
/// are dropped and counted. It allocates when it is made and never again.
template <class Entry>
class BoundedLog {
 public:
  /// Room for `capacity` entries; 0 keeps none and counts all.
  explicit BoundedLog(std::size_t capacity) : capacity_(capacity) { entries_.reserve(capacity); }

  /// Appends an entry; when there is no room, the oldest one goes. Constant time.
  void add(const Entry& entry) {
    if (entries_.size() < capacity_) {
      entries_.push_back(entry);
      return;
    }
    ++dropped_;
    if (capacity_ == 0) return;
    entries_[oldest_] = entry;
    oldest_ = (oldest_ + 1) % capacity_;
  }

  /// Appends all entries to `to`, the oldest first, and forgets them.
  void takeInto(std::vector<Entry>& to) {
    const auto oldest = entries_.begin() + static_cast<std::ptrdiff_t>(oldest_);
    to.insert(to.end(), oldest, entries_.end());
    to.insert(to.end(), entries_.begin(), oldest);
    entries_.clear();
    oldest_ = 0;
  }

  /// Entries that wait to be taken.
  std::size_t size() const { return entries_.size(); }
  /// Since it was made.
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::size_t capacity_;
  std::vector<Entry> entries_;
  std::size_t oldest_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace cairn::effects
