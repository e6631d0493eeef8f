// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "regions/region.h"
#include "regions/split_region.h"

namespace cairn::builder {

struct RegionNode {
  Region region;
  std::uint32_t parent = 0;  ///< the root is its own parent
  std::uint32_t firstChild = 0, childCount = 0;
};

/// Breadth-first, the children of a node contiguous, the root first.
using RegionTree = std::vector<RegionNode>;

/// Told after each region how many of the level's regions are done; false cancels.
using LevelProgress = std::function<bool(std::uint32_t level, std::size_t done, std::size_t count)>;

/// Divides the root's region level by level, the regions of a level in parallel (thesis Alg. 8). Each split is a pure
/// function of its region, so the result is the same for any number of threads. Empty when `progress` cancelled.
RegionTree growRegionTree(Region root, std::uint32_t depth, const SignedDistance& solid, const SplitSettings& settings,
                          const LevelProgress& progress);

}  // namespace cairn::builder
