// SPDX-License-Identifier: Zlib
#include "kernel/feature_lister.h"

#include <algorithm>

#include "kernel/patch_tests.h"

namespace cairn::bullet {

void FeatureLister::begin(const SurfacePair& surfaces, const ContactLimits& limits) {
  surfaces_ = &surfaces;
  limits_ = limits;
  a_.begin(surfaces.a, limits);
  b_.begin(surfaces.b, limits);
}

void FeatureLister::setSkin(float skin) {
  limits_.skin = skin;
  a_.setSkin(skin);
  b_.setSkin(skin);
}

bool FeatureLister::findNear(std::vector<PatchPair>& near, Budget& budget) {
  return nearPatches_.find(*surfaces_, a_, b_, near, budget);
}

bool FeatureLister::list(std::span<const PatchPair> near, float moved, Asked asked, FeatureLists& lists,
                         Budget& budget) {
  lists.clear();
  const PatchQuery question{*surfaces_, a_, b_, limits_.turn(), moved + limits_.skin + limits_.rounding(), asked};
  const auto isAsked = [&](const PatchPair& pair) { return pair.margin <= question.mostMargin; };
  if (!budget.charge(kOverlapTestCost * static_cast<std::uint64_t>(std::ranges::count_if(near, isAsked)))) return false;
  for (const PatchPair& pair : near) {
    if (!isAsked(pair)) continue;
    a_.place(pair.a);
    b_.place(pair.b);
  }
  // Testing patches takes long. Under a deadline, at most as many are tested together as a budget allows between two
  // reads of the clock.
  constexpr std::size_t kBetweenLooks = Budget::kClockInterval / SurfacePatch::kMaxTriangles;
  const std::size_t together = budget.hasDeadline() ? kBetweenLooks : near.size();
  for (; !near.empty(); near = near.subspan(std::min(together, near.size()))) {
    if (budget.isLate()) return false;
    testPatches(question, near.first(std::min(together, near.size())), lists);
  }
  return true;
}

}  // namespace cairn::bullet
