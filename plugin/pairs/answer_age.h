// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// The age of a pair's last answer and of its present traversal: how far the bodies may have approached each other
/// since each began. An answer is as old as the beginning of its traversal, because surfaces that were separated then
/// may touch by its end. Lengths are world lengths.
class AnswerAge {
 public:
  /// The bodies are too far apart for contacts, which counts as an answer. `centers`: from the other body's centre to
  /// the tree's.
  void cullSeparated(const Vec3& centers) {
    isAnswered_ = true;
    answer_ = {0, centers};
  }
  /// A traversal began. `approach`: how far the bodies may have approached each other before.
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
  /// Whether the bodies' centres have approached along `normal` (from the other body to the tree) since the last answer
  /// began.
  bool haveClosed(const Vec3& centers, const Vec3& normal, float size) const {
    return -dot(normal, centers - answer_.centers) > kApproachFraction * size;
  }
  /// Whether bodies that move by `travel` (world length) a step make any answer old by the next step.
  static bool isOutrunBy(float travel, float size) { return travel > kApproachFraction * size; }
  /// Whether the bodies have hardly approached since the last answer's traversal began, or since the present one did.
  bool isRecent(float size) const { return answer_.approach <= kApproachFraction * size; }
  bool isTraversalRecent(float size) const { return traversal_.approach <= kApproachFraction * size; }
  /// How far the bodies may have approached since the present traversal ruled pairs out, world length.
  float sinceTraversal() const { return traversal_.approach; }

  // For steps in which contacts only follow the bodies. `moved`: a bound on the relative motion since the traversal was
  // last begun or resumed. `size`: of the smaller body.

  /// Whether the last answer still holds.
  bool isAnsweredWithin(float moved, float size) const {
    return isAnswered_ && answer_.approach + moved <= kFollowedFraction * size;
  }
  /// Whether the spheres of the present traversal still hold.
  bool isTraversedWithin(float moved, float size) const {
    return traversal_.approach + moved <= kFollowedFraction * size;
  }
  /// Whether the last answer is too old to exclude contacts: bodies that were separated may overlap by now.
  bool isAbsenceStale(float moved, float size) const { return answer_.approach + moved > kApproachFraction * size; }

 private:
  struct Epoch {
    float approach = 0;
    Vec3 centers;
  };

  // An old answer counts for nothing after an approach of this fraction of the smaller body's size. For a body of one
  // metre and steps of 1/60 s this is 0.5 m/s in a single step.
  static constexpr float kApproachFraction = 0.008F;
  // Contacts that follow their bodies stand for an answer up to this motion, as a fraction of the same size.
  static constexpr float kFollowedFraction = 0.03F;

  bool isAnswered_ = false;   // a traversal ended once
  bool hadContacts_ = false;  // the last one found contacts
  Epoch answer_, traversal_;
};

}  // namespace cairn::bullet
