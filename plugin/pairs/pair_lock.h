// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// Locks a pair of trees whose bodies may hang in each other, or releases it. Guards forbid bodies to approach; rings
/// that hang in each other come free by parting. The guards of a locked pair act both ways.
///
/// A pair is locked while it has no valid answer (`needsAnswer`), moves fast, carried load, and its bodies' convex
/// hulls overlap by more than a quarter of the smaller size in each direction that is tried: the world's axes, and the
/// normal of its most loaded point. Compact bodies that touch overlap less in one of them, and part freely. One of the
/// meshes must bend inwards: nothing hangs in two convex bodies.
void lockOrRelease(TreePair& pair, const PairSides& sides, bool needsAnswer);

}  // namespace cairn::bullet
