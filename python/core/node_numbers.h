// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "cairn/core/sphere_tree.h"

namespace cairn::python {

/// Nodes as Python counts them: breadth-first, the root first. A range is [first, last).
using NodeRange = std::pair<std::uint32_t, std::uint32_t>;

/// The nodes at one depth, which lie side by side. Precondition: `level` <= `tree.depth()`. O(log n).
NodeRange nodesOfLevel(const SphereTree& tree, std::uint32_t level);

/// The children of a node, which lie side by side; an empty range for a leaf.
NodeRange childrenOf(const SphereTree& tree, std::uint32_t node);

/// All nodes of a level and all leaves above it. Precondition: `level` <= `tree.depth()`.
std::vector<std::uint32_t> cutOf(const SphereTree& tree, std::uint32_t level);

}  // namespace cairn::python
