// SPDX-License-Identifier: Zlib
#include "dispatch/broken_pairs.h"

#include <algorithm>
#include <cstdio>

#include "pairs/pair_settle.h"

namespace cairn::bullet {

void BrokenPairs::count() {
  ++count_;
  tell();
}

// Bullet's interface cannot return it.
void BrokenPairs::tell() {
  if (hasTold_.exchange(true)) return;
  std::fprintf(
      stderr,
      "a body's place, speed or force is no number or endless: its sphere-tree pairs have no contacts until it "
      "is one again (said once; StepStatistics::brokenPairs counts them)\n");
}

void BrokenPairs::forget(TreePair& pair) {
  if (!pair.notes.isOfCompound) return;
  std::erase(ofCompounds_, &pair);
  std::ranges::replace(leftOvers_, &pair, nullptr);
}

std::uint32_t BrokenPairs::settleLeftOvers(bool alsoCollected) {
  leftOvers_.clear();
  for (TreePair* const pair : ofCompounds_)
    if ((alsoCollected || !pair->notes.isCollected()) && isLeftOver(*pair)) leftOvers_.push_back(pair);
  std::uint32_t settled = 0;
  for (std::size_t i = 0; i < leftOvers_.size(); ++i) {
    if (!leftOvers_[i]) continue;
    forgetBroken(*leftOvers_[i]);
    ++settled;
  }
  leftOvers_.clear();
  if (settled > 0) tell();
  return settled;
}

}  // namespace cairn::bullet
