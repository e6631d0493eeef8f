// SPDX-License-Identifier: Zlib
#include "pairs/kept_answer.h"

#include <algorithm>

namespace cairn::bullet {

void KeptAnswer::reset() {
  forgetTraversal();
}

void KeptAnswer::forgetTraversal() {
  skin_ = 0;
  wandered_ = 0;
  gaps_.clear();
  leastGap_ = kUnknown;
  measuredInVain_ = 0;
  overlooked_ = 0;
  turn_ = 0;
}

// What moves on at once gains nothing from looking farther.
float KeptAnswer::begin(const Counterpart& counterpart, const RelativeMotion& motion) {
  forgetTraversal();
  const float skin = kSkinFraction * motion.smallerSize;
  const bool isSlow = 2 * motion.greatestSpeed() * motion.timeStep <= skin;
  if (counterpart.keepsAnswer() && isSlow) skin_ = skin;
  beganAt_ = motion.placement;
  allAreMeasured(motion);
  reach_ = motion.reach;
  return skin_;
}

void KeptAnswer::resume(const RelativePlacement& now) {
  wandered_ = wayWhilePicked_ = std::max(wandered_, static_cast<float>(now.displacementSince(beganAt_)));
}

// From wherever something was ruled out, the bodies have moved by no more than the way there and the way here.
bool KeptAnswer::holdsAt(const RelativePlacement& now, float reach) const {
  return skin_ > 0 && reach <= reach_ && wandered_ + static_cast<float>(now.displacementSince(beganAt_)) <= skin_;
}

bool KeptAnswer::isApartAt(const RelativePlacement& now, float reach, bool asksTriangles) const {
  if (!mayBeApart(reach)) return false;
  if (asksTriangles && isGapOfLeaves_) return false;
  return holdsAt(now, reach) && reach + static_cast<float>(now.displacementSince(measuredAt_)) <= leastGap_;
}

bool KeptAnswer::isStillAt(const RelativePlacement& now, float reach) const {
  constexpr float kStillFraction = 0.25F;
  return wayWhilePicked_ + static_cast<float>(now.displacementSince(pickedAt_)) <= kStillFraction * reach;
}

void KeptAnswer::pick(std::span<const NodePair> leafPairs, const RelativeMotion& motion,
                      std::span<const NodePair> known, Remeasured remeasured) {
  const bool isTooMuchAtOnce = remeasured == Remeasured::allIfFew && leafPairs.size() > kFew;
  areAllNear_ = gaps_.empty() || (isDueForAll(leafPairs.size()) && !isTooMuchAtOnce);
  // Or it would be due in each step from now on.
  if (isTooMuchAtOnce && isDueForAll(leafPairs.size())) measuredInVain_ = 0;
  const bool isOnlyTouching = !areAllNear_ && remeasured == Remeasured::touching && !known.empty();
  if (isOnlyTouching)
    near_.assign(known.begin(), known.end());
  else if (!areAllNear_)
    findNear(leafPairs, motion);
  picked_ = areAllNear_ ? leafPairs : std::span<const NodePair>(near_);
  wanted_ = picked_.size();
  const bool isTooMuch = remeasured == Remeasured::allIfFew && wanted_ > kFew;
  if (isTooMuch) pickFew(known);
  areAllPicked_ = !isOnlyTouching && !isTooMuch;
  overlooked_ = areAllPicked_ ? 0 : wayWhilePicked_ + static_cast<float>(motion.placement.displacementSince(pickedAt_));
}

void KeptAnswer::allAreMeasured(const RelativeMotion& motion) {
  pickedAt_ = motion.placement;
  wayWhilePicked_ = 0;
}

// Pairs whose surfaces were farther apart than the bodies have moved since still are.
void KeptAnswer::findNear(std::span<const NodePair> leafPairs, const RelativeMotion& motion) {
  const float near = motion.reach + static_cast<float>(motion.placement.displacementSince(measuredAt_));
  near_.clear();
  for (std::size_t i = 0; i < leafPairs.size(); ++i)
    if (gaps_[i] < near) near_.push_back(leafPairs[i]);
}

// What was in contact, and of the rest every so many, others in each step: faces that come flat upon each other are
// noticed all over them, and nothing is overlooked for long.
void KeptAnswer::pickFew(std::span<const NodePair> known) {
  few_.reserve(kFew);
  few_.assign(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(std::min(known.size(), kFew)));
  const std::size_t room = kFew - few_.size();
  const std::size_t stride = room > 0 ? (picked_.size() + room - 1) / room : 1;
  for (std::size_t i = turn_ % stride; i < picked_.size() && few_.size() < kFew; i += stride)
    if (std::ranges::find(known, picked_[i]) == known.end()) few_.push_back(picked_[i]);
  picked_ = few_;
  areAllNear_ = false;
}

void KeptAnswer::measureAll(Counterpart& counterpart, const RelativeMotion& motion, std::vector<Contact>& contacts) {
  const std::span<const NodePair> leafPairs = counterpart.traversal().leafPairs();
  gaps_.resize(leafPairs.size());
  counterpart.appendContacts(leafPairs, gaps_, contacts);
  measuredAt_ = motion.placement;
  allAreMeasured(motion);
  measuredInVain_ = 0;
  leastGap_ = -kUnknown;
  isGapOfLeaves_ = !leafPairs.empty();
  for (const float gap : gaps_) leastGap_ = std::min(leastGap_, gap);
}

void KeptAnswer::measureNear(Counterpart& counterpart, const RelativeMotion& motion, std::vector<Contact>& contacts) {
  if (areAllNear_) return measureAll(counterpart, motion, contacts);
  const std::size_t before = contacts.size();
  counterpart.appendContacts(picked_, contacts);
  measuredInVain_ += picked_.size() - std::min(picked_.size(), contacts.size() - before);
  if (areAllPicked_) allAreMeasured(motion);
  ++turn_;
}

void KeptAnswer::setGap(float gap, const RelativeMotion& motion) {
  gaps_.clear();
  leastGap_ = gap;
  isGapOfLeaves_ = false;
  measuredAt_ = motion.placement;
  allAreMeasured(motion);
}

void KeptAnswer::makeRoom(std::size_t count) {
  if (count > kFew) few_.reserve(kFew);
  if (gaps_.capacity() >= count) return;
  gaps_.reserve(count + count / 2);
  near_.reserve(count + count / 2);
}

void KeptAnswer::shrinkToFit() {
  gaps_.shrink_to_fit();
  near_ = std::vector<NodePair>();
  few_ = std::vector<NodePair>();
  picked_ = {};
}

}  // namespace cairn::bullet
