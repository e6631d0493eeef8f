// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hierarchy/region_tree.h"

namespace cairn::builder {

/// Grows a tree level by level over the whole surface instead of region by region (method `adaptive`): the two upper
/// levels together, then each further level all families at once, and only then divides the surface among the leaves.
/// The same result for any number of threads. Empty when `progress` cancelled. See docs/algorithms/adaptive.md.
RegionTree growLevels(Region root, std::uint32_t depth, const SignedDistance& solid, const SplitSettings& settings,
                      const LevelProgress& progress);

}  // namespace cairn::builder
