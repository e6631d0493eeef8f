// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "hierarchy/region_tree.h"
#include "levels/cover_level.h"

namespace cairn::builder {

/// Divides the surface among the leaves of a tree whose balls are known, top level first. A leaf may take a piece only
/// if all its ancestors hold the piece within their level's limit. Of these leaves the one with the least stand-off
/// takes it. Pieces that no leaf may take are bisected, so that seams cost almost nothing. The remaining small pieces
/// go where the limits are exceeded least.
///
/// A node's region consists of the pieces of its leaves. Its ball is the tighter of its former ball and one fitted to
/// that region. Nodes without pieces are dropped. Deterministic, parallel. Precondition: `levels` is not empty.
RegionTree divideAmongLeaves(Region root, std::span<const CoverLevel> levels, const SignedDistance& solid);

}  // namespace cairn::builder
