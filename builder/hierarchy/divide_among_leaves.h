// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "hierarchy/region_tree.h"
#include "levels/cover_level.h"

namespace cairn::builder {

/// Gives the surface to the leaves of a tree whose balls are known, top level first: a piece goes to the leaf that
/// holds it at the least stand-off among those all of whose ancestors hold it within their level's limit. Pieces no
/// leaf can have are bisected, so that seams cost almost nothing; what is left of them goes where the limits are
/// exceeded least. A node's region is what its leaves got, its ball the tighter of the one it had and one fitted to
/// that region; nodes without any are dropped. Deterministic, parallel inside. Precondition: `levels` not empty.
RegionTree divideAmongLeaves(Region root, std::span<const CoverLevel> levels, const SignedDistance& solid);

}  // namespace cairn::builder
