// SPDX-License-Identifier: Zlib
#include "dispatch/open_step.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>

#include "dispatch/step_pairs.h"
#include "pairs/pair_collect.h"

namespace cairn::bullet {

bool OpenStep::isOver(const TreePair& pair, bool isPrepared) const {
  if (isEnded_ || pair.notes.answeredIn == number_) return true;
  return !isPrepared &&
         std::any_of(witnesses_.begin(), witnesses_.end(), [](const TreePair* w) { return w->bodies.haveMoved(); });
}

void OpenStep::begin(btCollisionDispatcher& dispatcher, StepPairs& expected) {
  ++number_;
  isEnded_ = false;
  witnesses_.clear();
  lastNewcomers_ = newcomers_;
  newcomers_ = 0;
  for (std::size_t i = 0; i < known_.size();) {
    TreePair& pair = *known_[i];
    const bool isAwake = dispatcher.needsCollision(pair.bodies.object0(), pair.bodies.object1());
    if (isAwake && !follow(pair)) {
      forget(pair);  // moves another pair to its place
      continue;
    }
    if (isAwake) expected.add(pair);
    ++i;
  }
}

void OpenStep::answered(TreePair& pair, bool wasExpected) {
  pair.notes.answeredIn = number_;
  if (!wasExpected) ++newcomers_;
  // NaN poses always compare as moved.
  if (witnesses_.size() < kMaxWitnesses && !pair.is(PairStage::nonFinite)) witnesses_.push_back(&pair);
  if (pair.notes.knownAt != PairNotes::kNowhere) return;
  pair.notes.knownAt = known_.size();
  known_.push_back(&pair);
}

void OpenStep::forget(TreePair& pair) {
  std::erase(witnesses_, &pair);
  const std::size_t at = pair.notes.knownAt;
  if (at == PairNotes::kNowhere) return;
  pair.notes.knownAt = PairNotes::kNowhere;
  known_[at] = known_.back();
  known_.pop_back();
  if (at < known_.size()) known_[at]->notes.knownAt = at;
}

double OpenStep::reserve(std::size_t expected) const {
  const auto newcomers = static_cast<double>(lastNewcomers_);
  return std::max(kQuietReserve, newcomers / (newcomers + static_cast<double>(expected) + 1));
}

}  // namespace cairn::bullet
