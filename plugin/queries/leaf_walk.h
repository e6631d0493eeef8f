// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <bit>

#include "cairn/core/sphere_tree.h"
#include "queries/segment.h"

namespace cairn::bullet {

/// Calls `visit(leaf)` for the leaves that a query meets, nearest entry first among siblings.
///
///     walkLeaves(tree, entries, end, [&](NodeId leaf) { test(leaf); });
///
/// `entries(family, end)` tells where the query enters the spheres of the family with this index. `end()` tells how far
/// the query goes; it may shrink from visit to visit. No allocation.
template <class EntriesOf, class End, class Visit>
void walkLeaves(const SphereTree& tree, const EntriesOf& entries, const End& end, const Visit& visit) {
  struct Waiting {
    NodeId node;
    float at;
  };
  // Each level leaves at most seven nodes behind when the walk continues with the eighth.
  std::array<Waiting, (kFamilyWidth - 1) * kMaxDepth + kFamilyWidth> stack;
  std::size_t size = 0;
  const auto push = [&](std::uint32_t family) {
    const std::size_t first = size;
    const Entries found = entries(family, end());
    for (std::uint32_t lanes = found.lanes; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      std::size_t slot = size++;
      for (; slot > first && stack[slot - 1].at < found.at[lane]; --slot) stack[slot] = stack[slot - 1];
      stack[slot] = {family * kFamilyWidth + lane, found.at[lane]};
    }
  };
  push(kRootNode);
  while (size > 0) {
    const Waiting next = stack[--size];
    if (next.at > end()) continue;
    if (tree.isLeaf(next.node))
      visit(next.node);
    else
      push(tree.childFamily(next.node));
  }
}

}  // namespace cairn::bullet
