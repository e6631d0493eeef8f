// SPDX-License-Identifier: Zlib
#pragma once

#include <span>

#include "kernel/feature_lists.h"
#include "kernel/placed_patches.h"

namespace cairn::bullet {

/// What is asked of pairs of patches.
struct PatchQuestion {
  const SurfacePair& surfaces;
  const PlacedPatches &a, &b;
  float turn;        ///< how far, in radians, directions may turn while lists hold
  float mostMargin;  ///< only pairs of patches with no larger one are asked, world length
  Asked asked;
};

/// Appends, for each of these pairs, its features that may touch: vectors find a few more than there are, and whoever
/// asks decides each one by itself. The same bits on every instruction set. Precondition: the patches are placed.
void testPatches(const PatchQuestion& question, std::span<const PatchPair> pairs, FeatureLists& lists);

}  // namespace cairn::bullet
