// SPDX-License-Identifier: Zlib
#include "kernel/feature_lister.h"

#include "kernel/patch_tests.h"

namespace cairn::bullet {

void FeatureLister::begin(const SurfacePair& surfaces, const ContactLimits& limits) {
  surfaces_ = &surfaces;
  turn_ = limits.turn();
  a_.begin(surfaces.a, limits);
  b_.begin(surfaces.b, limits);
}

bool FeatureLister::findNear(std::vector<PatchPair>& near, Budget& budget) {
  return nearPatches_.find(*surfaces_, a_, b_, near, budget);
}

bool FeatureLister::list(std::span<const PatchPair> near, Asked asked, FeatureLists& lists, Budget& budget) {
  lists.clear();
  if (!budget.charge(kOverlapTestCost * near.size())) return false;
  for (const PatchPair& pair : near) {
    a_.place(pair.a);
    b_.place(pair.b);
  }
  testPatches({*surfaces_, a_, b_, turn_, asked}, near, lists);
  return true;
}

}  // namespace cairn::bullet
