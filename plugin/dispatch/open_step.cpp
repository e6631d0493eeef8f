// SPDX-License-Identifier: Zlib
#include "dispatch/open_step.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>

#include "pairs/tree_pair.h"

namespace cairn::bullet {

bool OpenStep::isOver(const TreePair& pair, bool isPrepared) const {
  if (isEnded_ || pair.answeredIn() == number_) return true;
  return !isPrepared &&
         std::any_of(witnesses_.begin(), witnesses_.end(), [](const TreePair* w) { return w->hasMoved(); });
}

void OpenStep::begin(btCollisionDispatcher& dispatcher, std::vector<TreePair*>& expected) {
  ++number_;
  isEnded_ = false;
  witnesses_.clear();
  lastNewcomers_ = newcomers_;
  newcomers_ = 0;
  for (std::size_t i = 0; i < known_.size();) {
    TreePair& pair = *known_[i];
    const bool isAwake = dispatcher.needsCollision(pair.object0(), pair.object1());
    if (isAwake && !pair.follow()) {
      forget(pair);  // puts another in its place
      continue;
    }
    if (isAwake) expected.push_back(&pair);
    ++i;
  }
}

void OpenStep::answered(TreePair& pair, bool wasExpected) {
  pair.setAnsweredIn(number_);
  if (!wasExpected) ++newcomers_;
  // What is no number is never where it was.
  if (witnesses_.size() < kMaxWitnesses && !pair.isBrokenPair()) witnesses_.push_back(&pair);
  if (pair.knownAt() != TreePair::kUnknown) return;
  pair.setKnownAt(known_.size());
  known_.push_back(&pair);
}

void OpenStep::forget(TreePair& pair) {
  std::erase(witnesses_, &pair);
  const std::size_t at = pair.knownAt();
  if (at == TreePair::kUnknown) return;
  pair.setKnownAt(TreePair::kUnknown);
  known_[at] = known_.back();
  known_.pop_back();
  if (at < known_.size()) known_[at]->setKnownAt(at);
}

double OpenStep::reserve(std::size_t expected) const {
  // From the root, where many of those known keep their answer or are held.
  const double newcomers = kNewcomersWeight * static_cast<double>(lastNewcomers_);
  return std::max(kQuietReserve, newcomers / (newcomers + static_cast<double>(expected) + 1));
}

}  // namespace cairn::bullet
