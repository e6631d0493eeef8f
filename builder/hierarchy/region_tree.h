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

/// Nodes in breadth-first order, the root first; the children of a node are contiguous.
using RegionTree = std::vector<RegionNode>;

/// Called after each region with the number of the level's regions that are done; returns false to cancel.
using LevelProgress = std::function<bool(std::uint32_t level, std::size_t done, std::size_t count)>;

/// Divides the root's region level by level (thesis Alg. 8). Regions of one level are divided in parallel. Each split
/// is a pure function of its region, so the result does not depend on the number of threads. Empty when `progress`
/// cancelled.
RegionTree growRegionTree(Region root, std::uint32_t depth, const SignedDistance& solid, const SplitSettings& settings,
                          const LevelProgress& progress);

}  // namespace cairn::builder
