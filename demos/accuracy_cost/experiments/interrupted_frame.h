// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/pose.h"
#include "cairn/core/scheduler.h"
#include "cairn/core/tree_pair_traversal.h"
#include "scenes/bodies/model.h"
#include "scenes/truth/frame_truth.h"

namespace cairn::accuracy_cost {

/// What the exact check says of some of a frame's contacts: no code of the sphere-trees.
struct ContactTruth {
  std::uint32_t checked = 0;  ///< pairs of spheres, spread evenly over all
  /// Distance between the solids at such a contact: the middle of what the spheres have in common, its distances from
  /// both solids added. What the certified error of the pair bounds. Fractions of body size.
  double separationSum = 0, worstSeparation = 0;
  std::uint32_t beyondCertificate = 0;  ///< of these contacts, farther apart than their spheres certify
  /// Pairs of bodies: that meet; that meet and have no pair of spheres; that have one and do not meet.
  std::uint32_t meeting = 0, missed = 0, invented = 0;
};

/// What the traversals of a frame have come to when they are interrupted (thesis 7.2). Lengths as fractions of body
/// size; the error of a pair of spheres is the sum of their certified errors.
struct Interrupted {
  std::uint64_t operations = 0;
  std::uint64_t spherePairs = 0;
  std::uint32_t bodyPairs = 0;                    ///< that have a pair of spheres
  bool isResolved = true;                         ///< all traversals have come to an end
  double worst = 0, mean = 0, rms = 0, best = 0;  ///< over all pairs of spheres; 0 without any
  ContactTruth truth;
};

/// Traverses the trees of all bodies of a scene that are of one model, frame by frame, each from the beginning.
class InterruptedFrame {
 public:
  /// The model must outlive it.
  explicit InterruptedFrame(const scenes::Model& model);

  /// All pairs of bodies whose root spheres overlap, traversed together round-robin (thesis 2.7.1) and interrupted
  /// after each of these numbers of operations, which ascend; `Budget::kUnlimited` is completion. Every interruption
  /// has its own traversals from the roots: what one finds does not depend on the others. With a truth, contacts are
  /// checked.
  std::vector<Interrupted> interrupt(std::span<const scenes::BodyMotion> motions,
                                     std::span<const std::uint64_t> operations, const scenes::FrameTruth* truth);

 private:
  struct BodyPair {
    int first, second;
    TreePairTraversal traversal;
  };

  void place(std::span<const scenes::BodyMotion> motions);
  void findPairs();
  Interrupted run(std::uint64_t operations);
  void addErrors(Interrupted& found) const;
  void check(const scenes::FrameTruth& truth, Interrupted& found) const;
  double separation(const scenes::FrameTruth& truth, const BodyPair& pair, const NodePair& nodes) const;

  const scenes::Model& model_;
  Pose bodyFromTree_;
  std::vector<Pose> poses_;
  std::vector<BodyPair> pairs_;  // the first `overlapping_` of them
  std::size_t overlapping_ = 0;
  std::vector<ScheduledPair> scheduled_;
};

}  // namespace cairn::accuracy_cost
