// SPDX-License-Identifier: Zlib
#include "cairn/core/rank_heap.h"

namespace cairn {

namespace {
bool isBefore(const RankHeap::Entry& a, const RankHeap::Entry& b) {
  return a.rank != b.rank ? a.rank > b.rank : a.ticket < b.ticket;
}
}  // namespace

void RankHeap::start(std::size_t count) {
  entries_.clear();
  place_.assign(count, 0);
}

void RankHeap::add(const Entry& entry) {
  entries_.push_back(entry);
  settle(entries_.size() - 1, entry);
}

void RankHeap::change(const Entry& entry) {
  settle(place_[entry.pair], entry);
}

void RankHeap::remove(std::size_t pair) {
  const std::size_t place = place_[pair];
  const Entry last = entries_.back();
  entries_.pop_back();
  if (place < entries_.size()) settle(place, last);
}

// Up while it goes before its parent, down while a child goes before it: never both.
void RankHeap::settle(std::size_t place, const Entry& entry) {
  while (place > 0 && isBefore(entry, entries_[(place - 1) / 2])) {
    put(place, entries_[(place - 1) / 2]);
    place = (place - 1) / 2;
  }
  for (std::size_t child = 2 * place + 1; child < entries_.size(); child = 2 * place + 1) {
    if (child + 1 < entries_.size() && isBefore(entries_[child + 1], entries_[child])) ++child;
    if (!isBefore(entries_[child], entry)) break;
    put(place, entries_[child]);
    place = child;
  }
  put(place, entry);
}

void RankHeap::put(std::size_t place, const Entry& entry) {
  entries_[place] = entry;
  place_[entry.pair] = place;
}

}  // namespace cairn
