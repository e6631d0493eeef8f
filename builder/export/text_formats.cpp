// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "cairn/builder/export.h"

namespace cairn::builder {
namespace {

Vec3d meshCenter(const SphereTree& tree, const NodeData& node) {
  return tree.origin() + Vec3d(node.center);
}

}  // namespace

Result<std::vector<Ball>> ballsOfLevel(const SphereTree& tree, std::uint32_t level) {
  if (level > tree.depth())
    return Error{fmt::format("the tree has levels 0 to {}, not {}; choose one of them", tree.depth(), level)};
  std::vector<Ball> balls;
  for (const NodeId node : tree.levelCut(level)) {
    const Sphere sphere = tree.sphere(node);
    balls.push_back({tree.origin() + Vec3d(sphere.center), sphere.radius, 0});
  }
  return balls;
}

std::string spheresText(const SphereTree& tree) {
  std::string text;
  for (std::uint32_t i = 0; i < tree.nodeCount(); ++i) {
    const NodeData& node = tree.data().nodes[i];
    const Vec3d c = meshCenter(tree, node);
    const std::int64_t parent = i == 0 ? -1 : static_cast<std::int64_t>(node.parent);
    // {} prints the shortest digits that read back as the same number.
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {}\n", tree.level(tree.nodeAt(i)), c.x, c.y, c.z,
                   static_cast<double>(node.radius), parent);
  }
  return text;
}

Result<std::string> sphText(const SphereTree& tree) {
  std::uint32_t degree = 1;
  for (std::uint32_t i = 0; i < tree.nodeCount(); ++i) degree = std::max(degree, tree.childCount(tree.nodeAt(i)));
  std::uint64_t slots = 0, width = 1;
  for (std::uint32_t level = 0; level <= tree.depth() && slots <= kMaxSphSlots; ++level, width *= degree)
    slots += width;
  if (slots > kMaxSphSlots)
    return Error{
        fmt::format("the complete tree of {} levels and degree {} that .sph stores has more than {} slots; export "
                    "to spheres instead",
                    tree.depth() + 1, degree, kMaxSphSlots)};

  std::vector<std::int64_t> nodeInSlot(slots, -1);
  std::vector<std::uint64_t> slotOf(tree.nodeCount(), 0), childrenSeen(tree.nodeCount(), 0);
  nodeInSlot[0] = 0;
  for (std::uint32_t i = 1; i < tree.nodeCount(); ++i) {  // breadth-first: a parent comes before its children
    const std::uint32_t parent = tree.data().nodes[i].parent;
    slotOf[i] = slotOf[parent] * degree + 1 + childrenSeen[parent]++;
    nodeInSlot[slotOf[i]] = i;
  }
  std::string text = fmt::format("{} {}\n", tree.depth() + 1, degree);
  for (const std::int64_t i : nodeInSlot) {
    if (i < 0) {
      text += "0 0 0 -1 0\n";
      continue;
    }
    const NodeData& node = tree.data().nodes[static_cast<std::size_t>(i)];
    const Vec3d c = meshCenter(tree, node);
    fmt::format_to(std::back_inserter(text), "{} {} {} {} 1\n", c.x, c.y, c.z, static_cast<double>(node.radius));
  }
  return text;
}

}  // namespace cairn::builder
