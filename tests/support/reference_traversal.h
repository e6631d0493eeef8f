// SPDX-License-Identifier: Zlib
#pragma once

#include <deque>
#include <vector>

#include "cairn/core/pose.h"
#include "cairn/core/traversal.h"

namespace cairn::test {

/// One step of a staircase traversal: a family, and the sphere it is tested against before and after it is moved.
struct FamilyStep {
  const Family* family = nullptr;
  const Similarity* move = nullptr;
  NodeId otherNode = 0;
  Sphere other;
  float margin = 0;  ///< in the family's unit, added to the moved radius
  std::uint32_t livingLanes = 0;

  Sphere movedOther() const { return {*move * other.center, other.radius * move->scale + margin}; }
};

/// The result of `TreePairTraversal`, one lane after the other and as plainly as possible; it keeps all its
/// steps.
class ReferenceTraversal {
 public:
  ReferenceTraversal(const SphereTree& a, const SphereTree& b, const Pose& poseA, const Pose& poseB, float margin)
      : a_{&a, relativePose(poseA, poseB), static_cast<float>(poseA.scale)},
        b_{&b, relativePose(poseB, poseA), static_cast<float>(poseB.scale)} {
    a_.margin = marginIn(a_, b_, margin);
    b_.margin = marginIn(b_, a_, margin);
    const FamilyStep roots = step(a_, 0, b_, kRootNode);
    if ((overlapScalar(*roots.family, roots.movedOther()) & 1U) != 0) add({kRootNode, kRootNode});
  }
  ReferenceTraversal(const ReferenceTraversal&) = delete;
  ReferenceTraversal& operator=(const ReferenceTraversal&) = delete;

  /// Refines the oldest pair of the front. Returns what it cost, 0 when there is none.
  std::uint64_t refineOne() {
    if (front.empty()) return 0;
    const NodePair pair = front.front();
    front.pop_front();
    const bool intoA = splitsA(pair);
    const Side &split = intoA ? a_ : b_, &other = intoA ? b_ : a_;
    const std::uint32_t family = split.tree->childFamily(intoA ? pair.a : pair.b);
    steps.push_back(step(split, family, other, intoA ? pair.b : pair.a));
    const std::uint32_t hits = overlapScalar(*steps.back().family, steps.back().movedOther());
    for (std::uint32_t lane = 0; lane < split.tree->familySize(family); ++lane)
      if ((hits >> lane & 1U) != 0)
        add(intoA ? NodePair{family * 8 + lane, pair.b} : NodePair{pair.a, family * 8 + lane});
    return kSphereUpdateCost + split.tree->familySize(family) * kOverlapTestCost;
  }

  std::vector<FamilyStep> steps;
  std::deque<NodePair> front;  ///< oldest first
  std::vector<NodePair> leafPairs;

 private:
  struct Side {
    const SphereTree* tree;
    Similarity fromOther;
    float scale, margin = 0;
  };

  static float marginIn(const Side& to, const Side& from, float margin) {
    const float lengths =
        length(to.fromOther.translation) + to.tree->extent() + to.fromOther.scale * from.tree->extent();
    return margin / to.scale + kOverlapSlack * lengths;
  }
  static FamilyStep step(const Side& split, std::uint32_t family, const Side& other, NodeId node) {
    return {&split.tree->family(family), &split.fromOther, node,
            other.tree->bound(node),     split.margin,     split.tree->livingLanes(family)};
  }
  bool splitsA(const NodePair& pair) const {
    if (a_.tree->isLeaf(pair.a)) return false;
    if (b_.tree->isLeaf(pair.b)) return true;
    return a_.tree->error(pair.a) * a_.scale >= b_.tree->error(pair.b) * b_.scale;
  }
  void add(const NodePair& pair) {
    if (a_.tree->isLeaf(pair.a) && b_.tree->isLeaf(pair.b))
      leafPairs.push_back(pair);
    else
      front.push_back(pair);
  }

  Side a_, b_;
};

}  // namespace cairn::test
