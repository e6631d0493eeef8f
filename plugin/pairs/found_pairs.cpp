// SPDX-License-Identifier: Zlib
#include "pairs/found_pairs.h"

#include <algorithm>

namespace cairn::bullet {

void FoundPairs::makeRoom() {
  pairs_.reserve(kMax);
  separations_.reserve(kMax);
}

void FoundPairs::clear() {
  pairs_.clear();
  separations_.clear();
}

void FoundPairs::add(std::span<const Contact> contacts) {
  for (const Contact& contact : contacts) put(contact);
}

void FoundPairs::put(const Contact& contact) {
  const auto same = std::ranges::find(pairs_, contact.pair);
  if (same != pairs_.end()) {
    float& separation = separations_[static_cast<std::size_t>(same - pairs_.begin())];
    separation = std::min(separation, contact.separation);
    return;
  }
  if (pairs_.size() < kMax) {
    pairs_.push_back(contact.pair);
    separations_.push_back(contact.separation);
    return;
  }
  const auto shallowest = std::ranges::max_element(separations_);
  if (contact.separation >= *shallowest) return;
  pairs_[static_cast<std::size_t>(shallowest - separations_.begin())] = contact.pair;
  *shallowest = contact.separation;
}

}  // namespace cairn::bullet
