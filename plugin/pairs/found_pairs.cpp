// SPDX-License-Identifier: Zlib
#include "pairs/found_pairs.h"

#include <algorithm>

namespace cairn::bullet {

void FoundPairs::makeRoom() {
  pairs_.reserve(kMost);
  gaps_.reserve(kMost);
}

void FoundPairs::clear() {
  pairs_.clear();
  gaps_.clear();
}

void FoundPairs::add(std::span<const Contact> contacts) {
  for (const Contact& contact : contacts) put(contact);
}

void FoundPairs::put(const Contact& contact) {
  const auto same = std::ranges::find(pairs_, contact.pair);
  if (same != pairs_.end()) {
    float& gap = gaps_[static_cast<std::size_t>(same - pairs_.begin())];
    gap = std::min(gap, contact.gap);
    return;
  }
  if (pairs_.size() < kMost) {
    pairs_.push_back(contact.pair);
    gaps_.push_back(contact.gap);
    return;
  }
  const auto shallowest = std::ranges::max_element(gaps_);
  if (contact.gap >= *shallowest) return;
  pairs_[static_cast<std::size_t>(shallowest - gaps_.begin())] = contact.pair;
  *shallowest = contact.gap;
}

}  // namespace cairn::bullet
