// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// How old an answer is, and the traversal at hand: by how much the bodies may have closed since each began. An answer
/// is as old as its traversal's beginning: what was apart then may touch by its end. Lengths are world lengths.
class AnswerAge {
 public:
  /// Everything is too far apart for contacts: that is an answer. `centers`: from the other body's centre to the
  /// tree's.
  void cullSeparated(const Vec3& centers) {
    isAnswered_ = true;
    answer_ = {0, centers};
  }
  /// `approach`: by how much the bodies may have closed before.
  void traversalBegan(float approach, const Vec3& centers) { traversal_ = {approach, centers}; }
  void traversalEnded(bool hasContacts) {
    isAnswered_ = true;
    hadContacts_ = hasContacts;
    answer_ = traversal_;
  }
  void approached(float sinceAnswer, float sinceTraversal) {
    answer_.approach += sinceAnswer;
    traversal_.approach += sinceTraversal;
  }

  bool isAnswered() const { return isAnswered_; }
  bool hadContacts() const { return hadContacts_; }
  /// Whether the bodies' centres have closed against `normal`, from the other to the tree, since the last answer began.
  bool haveClosed(const Vec3& centers, const Vec3& normal, float size) const {
    return -dot(normal, centers - answer_.centers) > kApproachFraction * size;
  }
  /// Whether bodies that move by this much a step, world length, make any answer old by the next.
  static bool isOutrunBy(float travel, float size) { return travel > kApproachFraction * size; }
  /// Whether the bodies have hardly closed since the traversal that gave the last answer began; and the one at hand.
  bool isRecent(float size) const { return answer_.approach <= kApproachFraction * size; }
  bool isTraversalRecent(float size) const { return traversal_.approach <= kApproachFraction * size; }
  /// How far what the traversal at hand has ruled out may have closed in, world length.
  float sinceTraversal() const { return traversal_.approach; }

  // Where contacts only follow the bodies. `moved`: by which these have moved against each other since the last
  // traversal was begun or resumed, at most. `size`: the smaller body's.

  /// Whether what was said last is an answer still.
  bool isAnsweredWithin(float moved, float size) const {
    return isAnswered_ && answer_.approach + moved <= kFollowedFraction * size;
  }
  /// Whether the traversal's spheres still are.
  bool isTraversedWithin(float moved, float size) const {
    return traversal_.approach + moved <= kFollowedFraction * size;
  }
  /// Whether it is too old to tell that nothing touches: what was apart then may be in each other by now.
  bool isAbsenceStale(float moved, float size) const { return answer_.approach + moved > kApproachFraction * size; }

 private:
  struct Epoch {
    float approach = 0;
    Vec3 centers;
  };

  // How far bodies may approach each other, as a fraction of the smaller one's size, before an old answer counts for
  // nothing. For a body of one metre and steps of 1/60 s this is 0.5 m/s in a single step, or less speed for longer.
  static constexpr float kApproachFraction = 0.008F;
  // How far bodies may move, as a fraction of the same, while contacts that follow them stand for an answer.
  static constexpr float kFollowedFraction = 0.03F;

  bool isAnswered_ = false;   // was a traversal ever done
  bool hadContacts_ = false;  // and did it find any
  Epoch answer_, traversal_;
};

}  // namespace cairn::bullet
