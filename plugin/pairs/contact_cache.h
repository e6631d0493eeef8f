// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "colliders/collider.h"
#include "contacts/relative_motion.h"
#include "memory/prefetch.h"

namespace cairn::bullet {

/// What of a kept answer is measured anew.
enum class RefreshPolicy : std::uint8_t {
  all,       ///< whatever may have come near
  allIfFew,  ///< the same, but where that is more than `ContactCache::kFewLeafPairs` leaf pairs so many: what was in
             ///< contact and, in turn, of the rest
  touching   ///< what was in contact; where nothing was, all
};

/// What a finished traversal found, for as long as it holds: a traversal of slow bodies looks a skin farther than it
/// must, and until they have moved by as much, its leaf pairs are all that can touch. Of these, only those that were
/// near are measured anew. See docs/algorithms/kept-answers.md.
class ContactCache {
 public:
  /// How much farther than needed a traversal of slow bodies looks, as a fraction of the smaller one's size.
  static constexpr float kSkinFraction = 0.006F;
  static constexpr std::size_t kFewLeafPairs = 48;

  void reset();
  /// A traversal begins at these poses. Returns how much farther it is to look, world length; 0 for fast bodies, and
  /// where the collider decides by more than poses.
  float begin(const Collider& collider, const RelativeMotion& motion);

  /// Whether the traversal at hand looks farther than needed, so that it pays to know how far apart its pairs are.
  bool isWanted() const { return skin_ > 0; }

  /// The traversal goes on at these poses: what it rules out from now on, it rules out here.
  void resume(const RelativePlacement& now);
  /// Whether the leaf pairs of the last traversal still are all that can come within `maxSeparation`. Precondition: it
  /// is done.
  bool holdsAt(const RelativePlacement& now, float maxSeparation) const;
  /// Whether besides none of them can touch, so that nothing need be measured. False where that is not known.
  /// `asksTriangles`: what leaves say is not enough where triangles can tell.
  bool isSeparatedAt(const RelativePlacement& now, float maxSeparation, bool asksTriangles) const;
  /// False where that is, wherever they are.
  bool mayBeSeparated(float maxSeparation) const { return minSeparation_ >= maxSeparation; }

  /// Whether the bodies have hardly moved since all leaf pairs that may be in contact were measured: by less than a
  /// quarter of the reach, so that what was no contact then is no overlap now.
  bool isStillAt(const RelativePlacement& now, float maxSeparation) const;
  /// Picks the leaf pairs to be measured at poses where the answer holds; see `near`. `known` are those that were in
  /// contact.
  void select(std::span<const NodePair> leafPairs, const RelativeMotion& motion, std::span<const NodePair> known,
              RefreshPolicy refresh);
  /// What was picked. Valid until the next `select` or traversal.
  std::span<const NodePair> near() const { return selected_; }
  /// How many they would have been, had it not mattered how many they are.
  std::size_t wanted() const { return wanted_; }
  /// Whether it is known how far apart they are, and worth knowing still.
  bool tellsNear(std::size_t leafPairs) const { return !separations_.empty() && !isDueForAll(leafPairs); }
  /// How far the bodies have moved, at most, since what was not picked but may be in contact was; world length.
  float staleness() const { return staleness_; }

  /// Measures all leaf pairs of a traversal that is done, and how far apart they are.
  void measureAll(Collider& collider, const RelativeMotion& motion, std::vector<Contact>& contacts);
  /// Measures what was picked.
  void measureNear(Collider& collider, const RelativeMotion& motion, std::vector<Contact>& contacts);

  /// How far apart the surfaces are now at least, told by something else than their leaf pairs; minus infinity where
  /// they touch.
  void setSeparation(float separation, const RelativeMotion& motion);

  /// See `prefetch`: of the lists, what `select` and `near` look at.
  void prefetchLists() const {
    prefetch(separations_.data(), separations_.size() * sizeof(float));
    prefetch(near_.data(), near_.size() * sizeof(NodePair));
  }

  /// Allocates what `count` leaf pairs may need, wanted now or not: a pair that slows down later allocates nothing.
  void makeRoom(std::size_t count);
  /// Frees memory that is not in use. Nothing is picked any more.
  void shrinkToFit();

 private:
  void forgetTraversal();
  // So many were measured in vain that all are to be measured again.
  bool isDueForAll(std::size_t leafPairs) const { return measuredInVain_ >= leafPairs; }
  void findNear(std::span<const NodePair> leafPairs, const RelativeMotion& motion);
  void selectFew(std::span<const NodePair> known);
  void allAreMeasured(const RelativeMotion& motion);

  static constexpr float kUnknown = -std::numeric_limits<float>::infinity();

  // First what tells whether nothing can touch: of most pairs nothing else is looked at in a step.
  float maxSeparation_ = 0;
  float skin_ = 0;
  float drift_ = 0;                    // greatest displacement from where it began while the traversal was under way
  float minSeparation_ = kUnknown;     // of `separations_`
  bool isSeparationOfLeaves_ = false;  // and whether leaves told it
  RelativePlacement beganAt_, measuredAt_;
  // Where all that may be in contact was picked and measured last, and how far it was from there where each was.
  RelativePlacement selectedAt_;
  float motionWhenSelected_ = 0;
  std::vector<float> separations_;  // one for each leaf pair, or none if they were not measured together
  // Leaf pairs measured since then that were no contacts. When they are as many as there are leaf pairs, measuring all
  // again costs no more than what it is likely to save.
  std::size_t measuredInVain_ = 0;
  std::vector<NodePair> near_, few_;
  std::span<const NodePair> selected_;  // of the traversal's own list, where all may be near
  bool areAllNear_ = false, areAllSelected_ = false;
  std::size_t wanted_ = 0, turn_ = 0;
  float staleness_ = 0;
};

}  // namespace cairn::bullet
