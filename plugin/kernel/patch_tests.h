// SPDX-License-Identifier: Zlib
#pragma once

#include <span>

#include "kernel/feature_lists.h"
#include "kernel/placed_patches.h"

namespace cairn::bullet {

/// The question put to pairs of patches.
struct PatchQuery {
  const SurfacePair& surfaces;
  const PlacedPatches &a, &b;
  float turn;        ///< bound, in radians, on how far directions turn while lists hold
  float mostMargin;  ///< pairs of patches with a larger margin are skipped, world length
  Asked asked;
};

/// Appends for each of these pairs its features that may touch. The result may hold a few pairs too many; the caller
/// decides each one exactly. The same bits on every instruction set. Precondition: the patches are placed.
void testPatches(const PatchQuery& question, std::span<const PatchPair> pairs, FeatureLists& lists);

}  // namespace cairn::bullet
