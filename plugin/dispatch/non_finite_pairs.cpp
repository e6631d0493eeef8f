// SPDX-License-Identifier: Zlib
#include "dispatch/non_finite_pairs.h"

#include <algorithm>

#include "cairn/core/log.h"
#include "pairs/pair_cull.h"

namespace cairn::bullet {

void NonFinitePairs::count() {
  ++count_;
  warn();
}

// In the log, because Bullet's interface cannot return it.
void NonFinitePairs::warn() {
  if (hasWarned_.exchange(true)) return;
  logMessage(
      "a body's place, speed or force is NaN or infinite: its sphere-tree pairs have no contacts until it is finite "
      "again "
      "(said once; StepStatistics::nonFinitePairs counts such pairs)");
}

void NonFinitePairs::forget(TreePair& pair) {
  if (!pair.notes.isOfCompound) return;
  std::erase(ofCompounds_, &pair);
  std::ranges::replace(leftOvers_, &pair, nullptr);
}

std::uint32_t NonFinitePairs::cullLeftOvers(bool alsoCollected) {
  leftOvers_.clear();
  for (TreePair* const pair : ofCompounds_)
    if ((alsoCollected || !pair->notes.isCollected()) && isLeftOver(*pair)) leftOvers_.push_back(pair);
  std::uint32_t culled = 0;
  for (std::size_t i = 0; i < leftOvers_.size(); ++i) {
    if (!leftOvers_[i]) continue;
    forgetNonFinite(*leftOvers_[i]);
    ++culled;
  }
  leftOvers_.clear();
  if (culled > 0) warn();
  return culled;
}

}  // namespace cairn::bullet
