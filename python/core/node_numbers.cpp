// SPDX-License-Identifier: Zlib
#include "core/node_numbers.h"

#include <algorithm>
#include <ranges>

namespace cairn::python {
namespace {

std::uint32_t numberOf(const SphereTree& tree, NodeId node) {
  return static_cast<std::uint32_t>(&tree.node(node) - tree.data().nodes.data());
}

/// The first node of a level or of a deeper one.
std::uint32_t firstOf(const SphereTree& tree, std::uint32_t level) {
  const auto numbers = std::views::iota(std::uint32_t{0}, tree.nodeCount());
  const auto isAbove = [&](std::uint32_t node) { return tree.level(tree.nodeAt(node)) < level; };
  return static_cast<std::uint32_t>(std::ranges::partition_point(numbers, isAbove) - numbers.begin());
}

}  // namespace

NodeRange nodesOfLevel(const SphereTree& tree, std::uint32_t level) {
  return {firstOf(tree, level), firstOf(tree, level + 1)};
}

NodeRange childrenOf(const SphereTree& tree, std::uint32_t node) {
  const NodeId id = tree.nodeAt(node);
  if (tree.isLeaf(id)) return {0, 0};
  const std::uint32_t first = numberOf(tree, tree.childFamily(id) * kFamilyWidth);
  return {first, first + tree.childCount(id)};
}

std::vector<std::uint32_t> cutOf(const SphereTree& tree, std::uint32_t level) {
  std::vector<std::uint32_t> numbers;
  for (const NodeId node : tree.levelCut(level)) numbers.push_back(numberOf(tree, node));
  return numbers;
}

}  // namespace cairn::python
