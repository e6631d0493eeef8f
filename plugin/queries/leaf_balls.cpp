// SPDX-License-Identifier: Zlib
#include "queries/leaf_balls.h"

#include <algorithm>

namespace cairn::bullet {

LeafBalls::LeafBalls(const SphereTree& tree) : families_(tree.families().size()) {
  const auto radiusOf = [&](NodeId node) -> float& {
    return families_[node / kFamilyWidth].radius[node % kFamilyWidth];
  };
  const auto last = tree.nodeCount();
  for (std::uint32_t record = 0; record < last; ++record) {
    const NodeId node = tree.nodeAt(record);
    const Sphere ball = tree.sphere(node);
    families_[node / kFamilyWidth].set(node % kFamilyWidth, {ball.center, tree.isLeaf(node) ? ball.radius : 0});
  }
  for (std::uint32_t record = 0; record < last; ++record) {
    const NodeId leaf = tree.nodeAt(record);
    if (!tree.isLeaf(leaf)) continue;
    const Sphere ball = tree.sphere(leaf);
    for (std::uint32_t above = record; above != 0;) {
      above = tree.data().nodes[above].parent;
      const NodeId node = tree.nodeAt(above);
      const float reach = distance(tree.sphere(node).center, ball.center) + ball.radius;
      radiusOf(node) = std::max(radiusOf(node), reach * (1 + kOverlapSlack));
    }
  }
}

}  // namespace cairn::bullet
