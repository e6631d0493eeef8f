// SPDX-License-Identifier: GPL-3.0-or-later
#include "certificates/probe_tree.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "random_tree.h"

namespace cairn::hard {
namespace {

constexpr std::uint32_t kLevels[] = {1, 8, 64, kProbes};

float roundedUp(long double value) {
  const auto f = static_cast<float>(value);
  return static_cast<long double>(f) < value ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

NodeData ballOfPoint(const Wide& point) {
  NodeData node;
  node.center = Vec3(point);
  node.radius = roundedUp(length(Wide(node.center) - point) * (1 + 0x1p-60L));
  node.radius = std::max(node.radius, std::numeric_limits<float>::min());
  return node;
}

/// Around the first child's centre, holding all of them.
NodeData ballOfChildren(std::span<const NodeData> children) {
  NodeData node;
  node.center = children[children.size() / 2].center;
  long double radius = 0;
  for (const NodeData& child : children)
    radius = std::max(radius, length(Wide(child.center) - Wide(node.center)) + static_cast<long double>(child.radius));
  node.radius = roundedUp(radius * (1 + 0x1p-60L));
  return node;
}

SphereTree treeOfLeaves(std::vector<NodeData> leaves) {
  std::vector<std::vector<NodeData>> levels(4);
  levels[3] = std::move(leaves);
  for (std::size_t level = 3; level-- > 0;)
    for (std::size_t i = 0; i < kLevels[level]; ++i)
      levels[level].push_back(ballOfChildren(std::span(levels[level + 1]).subspan(8 * i, 8)));
  SphereTreeData data;
  std::uint32_t firstOfParents = 0;
  for (std::uint32_t level = 0; level < 4; ++level) {
    const auto first = static_cast<std::uint32_t>(data.nodes.size());
    for (std::uint32_t i = 0; i < kLevels[level]; ++i) {
      NodeData& node = data.nodes.emplace_back(levels[level][i]);
      node.parent = level == 0 ? 0 : firstOfParents + i / 8;
      node.supportCount = 1;
      node.triangleCount = 4;
    }
    firstOfParents = first;
  }
  data.supportPoints = {data.nodes[0].center};
  test::detail::addTetrahedron(data);
  auto tree = SphereTree::create(std::move(data));
  if (!tree) throw std::runtime_error(tree.error().message);
  return std::move(tree).value();
}

}  // namespace

SphereTree probeTree(std::span<const Wide> points) {
  std::vector<NodeData> leaves;
  for (const Wide& point : points) leaves.push_back(ballOfPoint(point));
  return treeOfLeaves(std::move(leaves));
}

SphereTree probeTree(const Sphere& ball) {
  NodeData leaf;
  leaf.center = ball.center;
  leaf.radius = ball.radius;
  return treeOfLeaves(std::vector<NodeData>(kProbes, leaf));
}

NodeId nodeOfProbe(const SphereTree& tree, std::uint32_t index) {
  return tree.nodeAt(1 + 8 + 64 + index);
}

}  // namespace cairn::hard
