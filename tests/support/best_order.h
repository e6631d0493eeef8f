// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include "cairn/core/tree_pair_traversal.h"

namespace cairn::test {

/// Two trees at their poses. Errors are told as fractions of `size`, world length.
struct PlacedPair {
  const SphereTree *a = nullptr, *b = nullptr;
  Pose poseA, poseB;
  double size = 1;
};

/// How small the worst certified error of many pairs can be after some operations, whatever the order: of all pairs of
/// nodes always the worst is refined next. Priorities choose among pairs of trees, each of which goes breadth first.
class BestOrder {
 public:
  BestOrder(const std::vector<PlacedPair>& pairs, float margin) : pairs_(pairs), margin_(margin) {}

  double worstAfter(std::uint64_t operations) const {
    std::priority_queue<Open> open;
    for (std::size_t k = 0; k < pairs_.size(); ++k) open.push(opened(k, {kRootNode, kRootNode}));
    double worstResolved = 0;
    for (std::uint64_t used = 0; used < operations && !open.empty();) {
      const Open worst = open.top();
      open.pop();
      const PlacedPair& pair = pairs_[worst.pair];
      if (pair.a->isLeaf(worst.nodes.a) && pair.b->isLeaf(worst.nodes.b))
        worstResolved = std::max(worstResolved, worst.error);
      else
        used += refine(worst, open);
    }
    return open.empty() ? worstResolved : std::max(worstResolved, open.top().error);
  }

 private:
  struct Open {
    double error;
    std::size_t pair;
    NodePair nodes;
    bool operator<(const Open& other) const { return error < other.error; }
  };

  static double errorOf(const SphereTree& tree, NodeId node, const Pose& pose) {
    return double(tree.error(node)) * pose.scale;
  }
  Open opened(std::size_t k, const NodePair& nodes) const {
    const PlacedPair& p = pairs_[k];
    return {(errorOf(*p.a, nodes.a, p.poseA) + errorOf(*p.b, nodes.b, p.poseB)) / p.size, k, nodes};
  }
  // Splits the node that errs more, as traversals do; returns the operations.
  std::uint64_t refine(const Open& of, std::priority_queue<Open>& open) const {
    const PlacedPair& p = pairs_[of.pair];
    const NodePair& nodes = of.nodes;
    const bool splitsA = !p.a->isLeaf(nodes.a) &&
                         (p.b->isLeaf(nodes.b) || errorOf(*p.a, nodes.a, p.poseA) >= errorOf(*p.b, nodes.b, p.poseB));
    const SphereTree &split = splitsA ? *p.a : *p.b, &other = splitsA ? *p.b : *p.a;
    const Pose &splitPose = splitsA ? p.poseA : p.poseB, &otherPose = splitsA ? p.poseB : p.poseA;
    const NodeId node = splitsA ? nodes.a : nodes.b;
    const Similarity moved = relativePose(splitPose, otherPose);
    Sphere sphere = other.sphere(splitsA ? nodes.b : nodes.a);
    sphere = {moved * sphere.center, sphere.radius * moved.scale + margin_ / static_cast<float>(splitPose.scale)};
    const std::uint32_t hits = overlap(split.family(split.childFamily(node)), sphere);
    const NodeId first = split.childFamily(node) * kFamilyWidth;
    for (std::uint32_t lane = 0; lane < split.childCount(node); ++lane)
      if ((hits >> lane & 1U) != 0)
        open.push(opened(of.pair, splitsA ? NodePair{first + lane, nodes.b} : NodePair{nodes.a, first + lane}));
    return kSphereUpdateCost + split.childCount(node) * kOverlapTestCost;
  }

  const std::vector<PlacedPair>& pairs_;
  float margin_;
};

}  // namespace cairn::test
