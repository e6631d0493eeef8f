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
  float turn;                 ///< how far, in radians, directions may turn while lists hold
  bool asksCrossings = true;  ///< whether edges through faces are listed
};

/// Puts a patch's vertices into another frame: three columns, as long as the patch's own. Returns the box around them.
/// The same bits on every instruction set, like all that follows.
Box placeVertices(const SurfacePatch& patch, const Similarity& to, float* columns);

/// Appends, for each of these pairs, its features that may touch: vectors find a few more than there are, and whoever
/// asks decides each one by itself. Precondition: the patches are placed.
void testPatches(const PatchQuestion& question, std::span<const PatchPair> pairs, FeatureLists& lists);

}  // namespace cairn::bullet
