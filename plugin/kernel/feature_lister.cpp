// SPDX-License-Identifier: Zlib
#include "kernel/feature_lister.h"

#include "kernel/patch_tests.h"

namespace cairn::bullet {

bool FeatureLister::findNear(const SurfacePair& surfaces, const ContactLimits& limits, std::vector<PatchPair>& near,
                             Budget& budget) {
  a_.begin(surfaces.a, limits);
  b_.begin(surfaces.b, limits);
  return nearPatches_.find(surfaces, a_, b_, near, budget);
}

void FeatureLister::place(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const PatchPair> near) {
  a_.begin(surfaces.a, limits);
  b_.begin(surfaces.b, limits);
  for (const PatchPair& pair : near) {
    a_.place(pair.a);
    b_.place(pair.b);
  }
}

bool FeatureLister::list(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const PatchPair> near,
                         FeatureLists& lists, Budget& budget) {
  place(surfaces, limits, near);
  return listFound(surfaces, limits, near, lists, budget);
}

bool FeatureLister::listFound(const SurfacePair& surfaces, const ContactLimits& limits, std::span<const PatchPair> near,
                              FeatureLists& lists, Budget& budget) {
  lists.clear();
  if (!budget.charge(kOverlapTestCost * near.size())) return false;
  testPatches({surfaces, a_, b_, limits.turn()}, near, lists);
  return true;
}

bool FeatureLister::listTouching(const SurfacePair& surfaces, const ContactLimits& limits,
                                 std::span<const PatchPair> near, FeatureLists& lists, Budget& budget) {
  lists.clear();
  if (!budget.charge(kOverlapTestCost * near.size())) return false;
  place(surfaces, limits, near);
  testPatches({surfaces, a_, b_, limits.turn(), false}, near, lists);
  return true;
}

}  // namespace cairn::bullet
