// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "colliders/collider.h"
#include "contacts/relative_motion.h"
#include "platform/prefetch.h"

namespace cairn::bullet {

/// Which leaf pairs of a cached answer are measured again.
enum class RefreshPolicy : std::uint8_t {
  all,       ///< every leaf pair that may have come near
  allIfFew,  ///< as `all` up to `ContactCache::kFewLeafPairs`; beyond, those in contact and the rest in turn
  touching   ///< those in contact; all, where none was
};

/// Keeps the leaf pairs of a finished traversal while they remain valid. The traversal of slow bodies looks farther
/// than it must, by a skin. Until the bodies have moved by the skin, no other leaf pairs can touch. Only those that
/// were near are measured again. See docs/algorithms/contact-cache.md.
class ContactCache {
 public:
  /// Width of the skin, as a fraction of the smaller body's size.
  static constexpr float kSkinFraction = 0.006F;
  static constexpr std::size_t kFewLeafPairs = 48;

  void reset();
  /// A traversal begins at these poses. Returns the skin, world length. It is 0 for fast bodies, and where the collider
  /// depends on more than poses.
  float begin(const Collider& collider, const RelativeMotion& motion);

  /// Whether the present traversal has a skin, so that measuring separations pays.
  bool isWanted() const { return skin_ > 0; }

  /// The traversal continues at these poses: from now on it rules pairs out here.
  void resume(const RelativePlacement& now);
  /// Whether no other leaf pairs can come within `maxSeparation`. Precondition: the last traversal is done.
  bool holdsAt(const RelativePlacement& now, float maxSeparation) const;
  /// Whether in addition none of these leaf pairs can touch, so that nothing has to be measured. False where that is
  /// unknown. `asksTriangles`: separations of leaves are not enough where triangles can answer.
  bool isSeparatedAt(const RelativePlacement& now, float maxSeparation, bool asksTriangles) const;
  /// A cheap test: false where `isSeparatedAt` is false at all poses.
  bool mayBeSeparated(float maxSeparation) const { return minSeparation_ >= maxSeparation; }

  /// Whether the bodies have moved by less than a quarter of `maxSeparation` since all possible contacts were measured.
  /// Then no pair that was separated overlaps now.
  bool isStillAt(const RelativePlacement& now, float maxSeparation) const;
  /// Selects the leaf pairs to measure at poses where the cache is valid; see `near`. `known`: those that were in
  /// contact.
  void select(std::span<const NodePair> leafPairs, const RelativeMotion& motion, std::span<const NodePair> known,
              RefreshPolicy refresh);
  /// The selected leaf pairs. Valid until the next `select` or traversal.
  std::span<const NodePair> near() const { return selected_; }
  /// How many would have been selected without a limit.
  std::size_t wanted() const { return wanted_; }
  /// Whether separations are known and still worth using.
  bool tellsNear(std::size_t leafPairs) const { return !separations_.empty() && !isDueForAll(leafPairs); }
  /// Bound on the bodies' motion since leaf pairs that were not selected were last measured; world length.
  float staleness() const { return staleness_; }

  /// Measures all leaf pairs of a finished traversal, and their separations.
  void measureAll(Collider& collider, const RelativeMotion& motion, std::vector<Contact>& contacts);
  /// Measures the selected leaf pairs.
  void measureNear(Collider& collider, const RelativeMotion& motion, std::vector<Contact>& contacts);

  /// Sets a lower bound of the surfaces' separation from another source than leaf pairs; minus infinity where they
  /// touch.
  void setSeparation(float separation, const RelativeMotion& motion);

  /// Prefetches the lists that `select` and `near` read.
  void prefetchLists() const {
    prefetch(separations_.data(), separations_.size() * sizeof(float));
    prefetch(near_.data(), near_.size() * sizeof(NodePair));
  }

  /// Allocates memory for `count` leaf pairs in advance, so that a pair that slows down later allocates nothing.
  void makeRoom(std::size_t count);
  /// Frees unused memory. The selection becomes empty.
  void shrinkToFit();

 private:
  void forgetTraversal();
  // Too many leaf pairs were measured in vain since all were measured.
  bool isDueForAll(std::size_t leafPairs) const { return measuredInVain_ >= leafPairs; }
  void findNear(std::span<const NodePair> leafPairs, const RelativeMotion& motion);
  void selectFew(std::span<const NodePair> known);
  void allAreMeasured(const RelativeMotion& motion);

  static constexpr float kUnknown = -std::numeric_limits<float>::infinity();

  // First the data that excludes contacts: for most pairs a step reads nothing else.
  float maxSeparation_ = 0;
  float skin_ = 0;
  float drift_ = 0;                    // greatest displacement from `beganAt_` while the traversal went on
  float minSeparation_ = kUnknown;     // of `separations_`
  bool isSeparationOfLeaves_ = false;  // `minSeparation_` comes from leaves
  RelativePlacement beganAt_, measuredAt_;
  // The pose at which all possible contacts were last selected and measured, and the largest motion between that pose
  // and each measurement.
  RelativePlacement selectedAt_;
  float motionWhenSelected_ = 0;
  std::vector<float> separations_;  // one for each leaf pair, or empty if they were not measured together
  // Leaf pairs measured since then that were no contacts. When they are as many as all leaf pairs, measuring all again
  // costs no more than it is likely to save.
  std::size_t measuredInVain_ = 0;
  std::vector<NodePair> near_, few_;
  std::span<const NodePair> selected_;  // refers to the traversal's own list where all may be near
  bool areAllNear_ = false, areAllSelected_ = false;
  std::size_t wanted_ = 0, turn_ = 0;
  float staleness_ = 0;
};

}  // namespace cairn::bullet
