// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hierarchy/region_tree.h"

namespace cairn::builder {

/// Grows a tree level by level over the whole surface instead of region by region (method `adaptive`). The two upper
/// levels are fitted together, then each further level with all its families at once. Only then the surface is divided
/// among the leaves. The result does not depend on the number of threads. Empty when `progress` cancelled. See
/// docs/algorithms/adaptive.md.
RegionTree growLevels(Region root, std::uint32_t depth, const SignedDistance& solid, const SplitSettings& settings,
                      const LevelProgress& progress);

}  // namespace cairn::builder
