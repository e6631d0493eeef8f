// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/core/pose.h"
#include "cairn/core/traversal.h"

namespace cairn {

/// Staircase traversal of two sphere-trees (thesis 2.7.1, after Palmer and Grimsdale): each step splits one node of a
/// pair, the one with the larger certified error, and tests its children against the other sphere, which alone is
/// moved. A step costs one sphere update and one test per child (Eq. 2.1).
class CAIRN_CORE_EXPORT TreePairTraversal final : public Traversal {
 public:
  /// Begins anew at the two roots. `margin` (world length, >= 0): surfaces this far apart still count as touching. Both
  /// trees must outlive the traversal. The root test is part of starting and is not charged.
  void start(const SphereTree& a, const SphereTree& b, const Pose& poseA, const Pose& poseB, float margin);
  /// Goes on at moved bodies without forgetting what was found; pairs already dismissed stay dismissed until `start`.
  /// Precondition: started.
  void movePoses(const Pose& poseA, const Pose& poseB);

  Progress refine(Budget& budget) override;
  bool mayTouch(const NodePair& pair) const override;
  float pairError(const NodePair& pair) const override;
  float worstOf(std::span<const NodePair> pairs) const override;

 private:
  /// A tree and where it stands relative to the other.
  struct Side {
    const SphereTree* tree = nullptr;
    Similarity fromOther;
    float scale = 1;       // world length per tree unit
    float errorScale = 1;  // for errors, which may only grow by rounding
    float margin = 0;      // in tree units, with the rounding slack
  };
  void place(Side& side, const Side& other, const Pose& pose, const Pose& otherPose);

  Side a_, b_;
  float margin_ = 0;
};

}  // namespace cairn
