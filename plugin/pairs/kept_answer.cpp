// SPDX-License-Identifier: Zlib
#include "pairs/kept_answer.h"

#include <algorithm>

namespace cairn::bullet {

void KeptAnswer::reset() {
  forgetTraversal();
  uncrossed_ = 0;
}

void KeptAnswer::forgetTraversal() {
  skin_ = 0;
  wandered_ = 0;
  gaps_.clear();
  leastGap_ = kUnknown;
  measuredInVain_ = 0;
}

// What moves on at once gains nothing from looking farther.
float KeptAnswer::begin(const Counterpart& counterpart, const RelativeMotion& motion) {
  forgetTraversal();
  const float skin = kSkinFraction * motion.smallerSize;
  const bool isSlow = 2 * motion.greatestSpeed() * motion.timeStep <= skin;
  if (counterpart.keepsAnswer() && isSlow) skin_ = skin;
  beganAt_ = motion.placement;
  reach_ = motion.reach;
  return skin_;
}

void KeptAnswer::resume(const RelativePlacement& now) {
  wandered_ = std::max(wandered_, static_cast<float>(now.displacementSince(beganAt_)));
}

// From wherever something was ruled out, the bodies have moved by no more than the way there and the way here.
bool KeptAnswer::holdsAt(const RelativePlacement& now, float reach) const {
  return skin_ > 0 && reach <= reach_ && wandered_ + static_cast<float>(now.displacementSince(beganAt_)) <= skin_;
}

bool KeptAnswer::isApartAt(const RelativePlacement& now, float reach, bool asksTriangles) const {
  if (!mayBeApart(reach)) return false;
  if (asksTriangles && isGapOfLeaves_ && !isUncrossedAt(now)) return false;
  return holdsAt(now, reach) && reach + static_cast<float>(now.displacementSince(measuredAt_)) <= leastGap_;
}

bool KeptAnswer::isStill(const RelativeMotion& motion) const {
  constexpr float kStillFraction = 0.25F;
  return static_cast<float>(motion.placement.displacementSince(pickedAt_)) <= kStillFraction * motion.reach;
}

// Pairs whose surfaces were farther apart than the bodies have moved since still are.
void KeptAnswer::pick(std::span<const NodePair> leafPairs, const RelativeMotion& motion,
                      std::span<const NodePair> known, Remeasured remeasured) {
  const bool wantsFew = remeasured == Remeasured::allIfFew;
  areAllNear_ = gaps_.empty() || measuredInVain_ >= leafPairs.size();
  wanted_ = leafPairs.size();
  if (areAllNear_ && !(wantsFew && leafPairs.size() > kFew)) {
    leafPairs_ = leafPairs;
    pickedAt_ = motion.placement;
    return;
  }
  if (areAllNear_) {
    areAllNear_ = false;
    near_.assign(known.begin(), known.end());
    return;
  }
  if (remeasured == Remeasured::touching && !known.empty()) {
    near_.assign(known.begin(), known.end());
    wanted_ = near_.size();
    return;
  }
  const float near = motion.reach + static_cast<float>(motion.placement.displacementSince(measuredAt_));
  near_.clear();
  for (std::size_t i = 0; i < leafPairs.size(); ++i)
    if (gaps_[i] < near) near_.push_back(leafPairs[i]);
  wanted_ = near_.size();
  if (wantsFew && near_.size() > kFew)
    near_.assign(known.begin(), known.end());
  else
    pickedAt_ = motion.placement;
}

void KeptAnswer::measureAll(Counterpart& counterpart, const RelativeMotion& motion, std::vector<Contact>& contacts) {
  const std::span<const NodePair> leafPairs = counterpart.traversal().leafPairs();
  gaps_.resize(leafPairs.size());
  counterpart.appendContacts(leafPairs, gaps_, contacts);
  measuredAt_ = motion.placement;
  pickedAt_ = motion.placement;
  measuredInVain_ = 0;
  leastGap_ = -kUnknown;
  isGapOfLeaves_ = counterpart.hasTriangles() && !leafPairs.empty();
  for (const float gap : gaps_) leastGap_ = std::min(leastGap_, gap);
}

void KeptAnswer::measureNear(Counterpart& counterpart, const RelativeMotion& motion, std::vector<Contact>& contacts) {
  if (areAllNear_) return measureAll(counterpart, motion, contacts);
  const std::size_t before = contacts.size();
  counterpart.appendContacts(near_, contacts);
  measuredInVain_ += near_.size() - std::min(near_.size(), contacts.size() - before);
}

void KeptAnswer::setGap(float gap, const RelativeMotion& motion) {
  gaps_.clear();
  leastGap_ = gap;
  isGapOfLeaves_ = false;
  measuredAt_ = motion.placement;
}

// Beyond its leaf pairs a traversal has ruled out everything within `gapOfInterest` where it ruled it out, which is as
// far from here as the bodies have moved since; of fast bodies it has ruled out what is within the reach.
void KeptAnswer::setUncrossed(float gap, const RelativeMotion& motion) {
  const float wandered = wandered_ + static_cast<float>(motion.placement.displacementSince(beganAt_));
  uncrossed_ = std::min(gap, reach_ + skin_ - wandered);
  uncrossedAt_ = motion.placement;
}

bool KeptAnswer::isUncrossedAt(const RelativePlacement& now) const {
  return uncrossed_ > 0 && static_cast<float>(now.displacementSince(uncrossedAt_)) < uncrossed_;
}

void KeptAnswer::makeRoom(std::size_t count) {
  if (gaps_.capacity() >= count) return;
  gaps_.reserve(count + count / 2);
  near_.reserve(count + count / 2);
}

}  // namespace cairn::bullet
