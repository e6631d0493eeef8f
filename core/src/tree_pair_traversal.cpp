// SPDX-License-Identifier: Zlib
#include "cairn/core/tree_pair_traversal.h"

#include <bit>
#include <cassert>

namespace cairn {

namespace {

float conservativeMargin(float margin, const Similarity& toFrom, const SphereTree& to, const SphereTree& from) {
  const float lengths = length(toFrom.translation) + to.reach() + toFrom.scale * from.reach();
  return margin + kOverlapSlack * lengths;
}

}  // namespace

void TreePairTraversal::start(const SphereTree& a, const SphereTree& b, const Pose& poseA, const Pose& poseB,
                              float margin) {
  assert(margin >= 0);
  clear();
  a_ = &a;
  b_ = &b;
  margin_ = margin;
  movePoses(poseA, poseB);

  Sphere rootB = b.sphere(kRootNode);
  rootB = {aFromB_ * rootB.center, rootB.radius * aFromB_.scale + marginInA_};
  if ((overlap(a.family(0), rootB) & 1U) == 0) return;
  const bool resolved = a.isLeaf(kRootNode) && b.isLeaf(kRootNode);
  (resolved ? leafPairs_ : queue_).push_back({kRootNode, kRootNode});
}

void TreePairTraversal::movePoses(const Pose& poseA, const Pose& poseB) {
  aFromB_ = relativePose(poseA, poseB);
  bFromA_ = relativePose(poseB, poseA);
  scaleA_ = static_cast<float>(poseA.scale);
  scaleB_ = static_cast<float>(poseB.scale);
  marginInA_ = conservativeMargin(margin_ / scaleA_, aFromB_, *a_, *b_);
  marginInB_ = conservativeMargin(margin_ / scaleB_, bFromA_, *b_, *a_);
}

Progress TreePairTraversal::refine(Budget& budget) {
  while (head_ < queue_.size()) {
    const NodePair pair = queue_[head_];
    const bool intoA = splitsA(pair);
    const std::uint32_t children = intoA ? a_->childCount(pair.a) : b_->childCount(pair.b);
    if (!budget.charge(kSphereUpdateCost + children * kOverlapTestCost)) return Progress::budgetSpent;
    ++head_;
    if (intoA)
      splitA(pair);
    else
      splitB(pair);
  }
  return Progress::done;
}

bool TreePairTraversal::splitsA(const NodePair& pair) const {
  if (a_->isLeaf(pair.a)) return false;
  if (b_->isLeaf(pair.b)) return true;
  return a_->error(pair.a) * scaleA_ >= b_->error(pair.b) * scaleB_;
}

void TreePairTraversal::splitA(const NodePair& pair) {
  const std::uint32_t family = a_->childFamily(pair.a);
  const Sphere s = b_->sphere(pair.b);
  const bool otherIsLeaf = b_->isLeaf(pair.b);
  std::uint32_t hits = overlap(a_->family(family), {aFromB_ * s.center, s.radius * aFromB_.scale + marginInA_});
  hits &= a_->livingLanes(family);
  for (; hits != 0; hits &= hits - 1) {
    const NodeId child = family * kFamilyWidth + static_cast<NodeId>(std::countr_zero(hits));
    (otherIsLeaf && a_->isLeaf(child) ? leafPairs_ : queue_).push_back({child, pair.b});
  }
}

void TreePairTraversal::splitB(const NodePair& pair) {
  const std::uint32_t family = b_->childFamily(pair.b);
  const Sphere s = a_->sphere(pair.a);
  const bool otherIsLeaf = a_->isLeaf(pair.a);
  std::uint32_t hits = overlap(b_->family(family), {bFromA_ * s.center, s.radius * bFromA_.scale + marginInB_});
  hits &= b_->livingLanes(family);
  for (; hits != 0; hits &= hits - 1) {
    const NodeId child = family * kFamilyWidth + static_cast<NodeId>(std::countr_zero(hits));
    (otherIsLeaf && b_->isLeaf(child) ? leafPairs_ : queue_).push_back({pair.a, child});
  }
}

float TreePairTraversal::pairError(const NodePair& pair) const {
  return a_->error(pair.a) * scaleA_ + b_->error(pair.b) * scaleB_;
}

}  // namespace cairn
