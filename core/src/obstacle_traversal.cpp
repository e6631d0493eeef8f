// SPDX-License-Identifier: Zlib
#include "cairn/core/obstacle_traversal.h"

#include <algorithm>
#include <bit>

namespace cairn {

void ObstacleTraversal::start(const SphereTree& tree, float scale, const Obstacle& obstacle) {
  abandon();
  tree_ = &tree;
  obstacle_ = &obstacle;
  errorScale_ = static_cast<float>(static_cast<double>(scale) * kErrorGrowth);
  PairList& list = tree.isLeaf(kRootNode) ? leafPairs_ : queue_;
  for (std::uint32_t element = 0; element < obstacle.elementCount(); ++element)
    if ((obstacle.touches(tree.family(0), 1, element) & 1U) != 0) list.push_back({kRootNode, element});
}

Progress ObstacleTraversal::refine(Budget& budget) {
  noteFront();
  while (head_ < queue_.size()) {
    const NodePair pair = queue_.data()[head_];
    const std::uint32_t family = tree_->childFamily(pair.a);
    const std::uint32_t size = tree_->familySize(family);
    if (!budget.charge(kSphereUpdateCost + size * kOverlapTestCost)) return Progress::budgetSpent;
    ++head_;
    std::uint32_t hits = obstacle_->touches(tree_->family(family), size, pair.b) & tree_->livingLanes(family);
    for (; hits != 0; hits &= hits - 1) {
      const NodeId child = family * kFamilyWidth + static_cast<NodeId>(std::countr_zero(hits));
      (tree_->isLeaf(child) ? leafPairs_ : queue_).push_back({child, pair.b});
    }
  }
  return Progress::done;
}

bool ObstacleTraversal::mayTouch(const NodePair& pair) const {
  if (tree_->spheresPerNode() == 1) return true;
  Family ofNode;
  ofNode.set(0, tree_->sphere(pair.a));
  return (obstacle_->touches(ofNode, 1, pair.b) & 1U) != 0;
}

float ObstacleTraversal::pairError(const NodePair& pair) const {
  return tree_->error(pair.a) * errorScale_;
}

float ObstacleTraversal::worstOf(std::span<const NodePair> pairs) const {
  float worst = 0;
  for (const NodePair& pair : pairs) worst = std::max(worst, tree_->error(pair.a) * errorScale_);
  return worst;
}

}  // namespace cairn
