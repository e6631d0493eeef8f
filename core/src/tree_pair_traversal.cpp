// SPDX-License-Identifier: Zlib
#include "cairn/core/tree_pair_traversal.h"

#include <algorithm>
#include <cassert>

#include "staircase.h"

namespace cairn {

void TreePairTraversal::start(const SphereTree& a, const SphereTree& b, const Pose& poseA, const Pose& poseB,
                              float margin) {
  assert(margin >= 0);
  abandon();
  a_.tree = &a;
  b_.tree = &b;
  margin_ = margin;
  movePoses(poseA, poseB);

  Sphere rootB = b.bound(kRootNode);
  rootB = {a_.fromOther * rootB.center, rootB.radius * a_.fromOther.scale + a_.margin};
  if ((overlap(a.family(0), rootB) & 1U) == 0) return;
  const bool resolved = a.isLeaf(kRootNode) && b.isLeaf(kRootNode);
  (resolved ? leafPairs_ : queue_).push_back({kRootNode, kRootNode});
}

void TreePairTraversal::movePoses(const Pose& poseA, const Pose& poseB) {
  place(a_, b_, poseA, poseB);
  place(b_, a_, poseB, poseA);
}

void TreePairTraversal::place(Side& side, const Side& other, const Pose& pose, const Pose& otherPose) {
  side.fromOther = relativePose(pose, otherPose);
  const auto scale = static_cast<float>(pose.scale);
  if (side.scale != scale) forgetErrors();
  side.scale = scale;
  side.errorScale = static_cast<float>(pose.scale * kErrorGrowth);
  const float lengths =
      length(side.fromOther.translation) + side.tree->extent() + side.fromOther.scale * other.tree->extent();
  side.margin = margin_ / side.scale + kOverlapSlack * lengths;
}

Progress TreePairTraversal::refine(Budget& budget) {
  if (done()) return Progress::done;
  noteFront();
  const auto body = [](const Side& side) {
    return StaircaseBody{side.tree->families().data(), side.tree->traversalNodes().data(), side.fromOther, side.scale,
                         side.margin};
  };
  return refineStaircase(body(a_), body(b_), {queue_, head_, leafPairs_}, budget);
}

bool TreePairTraversal::mayTouch(const NodePair& pair) const {
  if (a_.tree->spheresPerNode() == 1 && b_.tree->spheresPerNode() == 1) return true;
  Family ofA;
  ofA.set(0, a_.tree->sphere(pair.a));
  const Sphere b = b_.tree->sphere(pair.b);
  return (overlap(ofA, {a_.fromOther * b.center, b.radius * a_.fromOther.scale + a_.margin}) & 1U) != 0;
}

float TreePairTraversal::pairError(const NodePair& pair) const {
  return a_.tree->error(pair.a) * a_.errorScale + b_.tree->error(pair.b) * b_.errorScale;
}

float TreePairTraversal::worstOf(std::span<const NodePair> pairs) const {
  const TraversalNode* const a = a_.tree->traversalNodes().data();
  const TraversalNode* const b = b_.tree->traversalNodes().data();
  const float scaleA = a_.errorScale, scaleB = b_.errorScale;
  float worst = 0;
  for (const NodePair& pair : pairs) worst = std::max(worst, a[pair.a].error * scaleA + b[pair.b].error * scaleB);
  return worst;
}

}  // namespace cairn
