// SPDX-License-Identifier: Zlib
#include "pairs/known_pairs.h"

#include <algorithm>

namespace cairn::bullet {

void KnownPairs::reset() {
  pairs_.clear();
  retested_.clear();
  isRetested_ = false;
}

void KnownPairs::remember(const NodePair& leaves) {
  if (std::ranges::find(pairs_, leaves) == pairs_.end()) pairs_.push_back(leaves);
}

void KnownPairs::rememberDeepest(const Collider& collider, std::vector<Contact>& contacts) {
  const std::size_t count = std::min(contacts.size(), kMax);
  std::partial_sort(contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(count), contacts.end(), deeper);
  for (std::size_t i = 0; i < count && pairs_.size() < kMax; ++i)
    if (!contacts[i].ofSpheres) remember(collider.leavesOf(contacts[i]));
}

// Each leaf pair may have dozens of contacts; the deepest are kept. Memory is reserved at once: rolling bodies would
// otherwise need a little more for minutes.
void KnownPairs::retest(Collider& collider, Budget& budget, std::vector<Contact>& all) {
  if (isRetested_) return;
  isRetested_ = true;
  budget.forceCharge(kContactCost * static_cast<std::uint32_t>(pairs_.size()));
  all.clear();
  collider.appendContacts(pairs_, all);
  if (all.size() > kMaxRetested) std::partial_sort(all.begin(), all.begin() + kMaxRetested, all.end(), deeper);
  const std::size_t count = std::min(all.size(), kMaxRetested);
  retested_.reserve(count <= kMaxOfAll ? kMaxOfAll : kMaxRetested);
  retested_.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace cairn::bullet
