// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/budget.h"
#include "kernel/family_test.h"
#include "kernel/placed_patches.h"

namespace cairn::bullet {

/// Finds which patches of two surfaces may touch, by their boxes. First come the patches of A near the largest boxes of
/// B, then for each of them the patches of B near it. Eight boxes are compared at a time.
class NearPatches {
 public:
  /// Replaces `found` by these pairs and places their patches in `a` and `b`. Returns false when the budget does not
  /// suffice. The same bits on every instruction set. Precondition: `a` and `b` have begun.
  bool find(const SurfacePair& surfaces, PlacedPatches& a, PlacedPatches& b, std::vector<PatchPair>& found,
            Budget& budget);
  /// Lower bound on the separation of all surface outside the patches found last; world length.
  float minSeparation() const { return minSeparation_; }

 private:
  // Finds A's patches near any of the boxes at B's root.
  bool findNearOfA(const SurfacePair& surfaces, const PlacedPatches& a, const PlacedPatches& b, Budget& budget);
  // Calls `onPatch` with each patch of the surface that may touch the box (the surface's frame). `mayTouch` rules out
  // families.
  template <class MayTouch, class OnPatch>
  bool descend(const PlacedSurface& surface, const PlacedBox& box, const NearLimits& limits, Budget& budget,
               const MayTouch& mayTouch, const OnPatch& onPatch);

  std::vector<std::uint32_t> waiting_, nearOfA_;  // families; patches
  float minSeparation_ = 0;
};

}  // namespace cairn::bullet
