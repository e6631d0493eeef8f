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

/// The result of the exact check for some of a frame's contacts. The check uses no code of the sphere-trees.
struct ContactTruth {
  std::uint32_t checked = 0;  ///< number of checked pairs of spheres, spread evenly over all
  /// Distance between the solids at such a contact, as a fraction of body size. It is the sum of both solids' distances
  /// from the middle of the two spheres' intersection. The certified error of the pair bounds it.
  double separationSum = 0, worstSeparation = 0;
  std::uint32_t beyondCertificate = 0;  ///< contacts whose solids are farther apart than the spheres certify
  /// Counts of body pairs: those that meet; those that meet without a pair of spheres; those that have one and do not
  /// meet.
  std::uint32_t meeting = 0, missed = 0, invented = 0;
};

/// The state of a frame's traversals at an interruption (thesis 7.2). Lengths are fractions of body size. The error of
/// a pair of spheres is the sum of their certified errors. Pairs of bounds whose spheres are apart do not count.
struct Interrupted {
  std::uint64_t operations = 0;
  std::uint64_t spherePairs = 0;
  std::uint32_t bodyPairs = 0;                    ///< with at least one pair of spheres
  bool isResolved = true;                         ///< all traversals are complete
  double worst = 0, mean = 0, rms = 0, best = 0;  ///< over all pairs of spheres; 0 without any
  ContactTruth truth;
};

/// Traverses the trees of all bodies of a scene with one model, frame by frame, each from the beginning.
class InterruptedFrame {
 public:
  /// The model must outlive this object.
  explicit InterruptedFrame(const scenes::Model& model);

  /// Traverses all pairs of bodies whose root spheres overlap, together and round-robin (thesis 2.7.1). Interrupts them
  /// after each of the given numbers of operations; `Budget::kUnlimited` means completion. Every interruption has its
  /// own traversals from the roots, so its result does not depend on the others. Contacts are checked when `truth` is
  /// given. Precondition: `operations` is ascending.
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
  /// Calls `visit(body pair, its traversal's pair of nodes)` for each pair of spheres that answers.
  template <class Visit>
  void forEachAnswer(const Visit& visit) const;
  void addErrors(Interrupted& found) const;
  void check(const scenes::FrameTruth& truth, Interrupted& found) const;
  double separation(const scenes::FrameTruth& truth, const BodyPair& pair, const NodePair& nodes) const;

  const scenes::Model& model_;
  Pose bodyFromTree_;
  std::vector<Pose> poses_;
  std::vector<BodyPair> pairs_;  // only the first `overlapping_` are in use
  std::size_t overlapping_ = 0;
  std::vector<ScheduledPair> scheduled_;
};

}  // namespace cairn::accuracy_cost
