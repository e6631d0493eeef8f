// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/budget.h"
#include "kernel/family_test.h"
#include "kernel/placed_patches.h"

namespace cairn::bullet {

/// Which patches of two surfaces may touch, by their boxes: those of A near the largest boxes of B, and of each of them
/// those of B near it. Eight boxes are compared at a time.
class NearPatches {
 public:
  /// Replaces `found` by these pairs, and places what stands in them. False when the budget does not cover the boxes
  /// that are compared. The same on every instruction set. Precondition: `a` and `b` have begun.
  bool find(const SurfacePair& surfaces, PlacedPatches& a, PlacedPatches& b, std::vector<PatchPair>& found,
            Budget& budget);
  /// How far apart the surfaces are outside of what was found last, at least; world length.
  float minSeparation() const { return minSeparation_; }

 private:
  // Those of A near any of the boxes at the root of B's.
  bool findNearOfA(const SurfacePair& surfaces, const PlacedPatches& a, const PlacedPatches& b, Budget& budget);
  // Calls `onPatch` with each patch of the surface that may touch the box, in the surface's frame, and is in no family
  // that may not.
  template <class MayTouch, class OnPatch>
  bool descend(const PlacedSurface& surface, const PlacedBox& box, const NearLimits& limits, Budget& budget,
               const MayTouch& mayTouch, const OnPatch& onPatch);

  std::vector<std::uint32_t> waiting_, nearOfA_;  // families; patches
  float minSeparation_ = 0;
};

}  // namespace cairn::bullet
