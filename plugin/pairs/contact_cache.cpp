// SPDX-License-Identifier: Zlib
#include "pairs/contact_cache.h"

#include <algorithm>

namespace cairn::bullet {

void ContactCache::reset() {
  forgetTraversal();
}

void ContactCache::forgetTraversal() {
  skin_ = 0;
  drift_ = 0;
  separations_.clear();
  minSeparation_ = kUnknown;
  measuredInVain_ = 0;
  staleness_ = 0;
  turn_ = 0;
}

// Bodies that move on at once gain nothing from a skin.
float ContactCache::begin(const Collider& collider, const RelativeMotion& motion) {
  forgetTraversal();
  const float skin = kSkinFraction * motion.smallerSize;
  const bool isSlow = 2 * motion.greatestSpeed() * motion.timeStep <= skin;
  if (collider.isCacheable() && isSlow) skin_ = skin;
  beganAt_ = motion.placement;
  allAreMeasured(motion);
  maxSeparation_ = motion.maxSeparation;
  return skin_;
}

void ContactCache::resume(const RelativePlacement& now) {
  drift_ = motionWhenSelected_ = std::max(drift_, static_cast<float>(now.displacementSince(beganAt_)));
}

// Bound on the motion since any pair was ruled out: the drift during the traversal plus the motion since its beginning.
bool ContactCache::holdsAt(const RelativePlacement& now, float maxSeparation) const {
  return skin_ > 0 && maxSeparation <= maxSeparation_ &&
         drift_ + static_cast<float>(now.displacementSince(beganAt_)) <= skin_;
}

bool ContactCache::isSeparatedAt(const RelativePlacement& now, float maxSeparation, bool asksTriangles) const {
  if (!mayBeSeparated(maxSeparation)) return false;
  if (asksTriangles && isSeparationOfLeaves_) return false;
  return holdsAt(now, maxSeparation) &&
         maxSeparation + static_cast<float>(now.displacementSince(measuredAt_)) <= minSeparation_;
}

bool ContactCache::isStillAt(const RelativePlacement& now, float maxSeparation) const {
  constexpr float kStillFraction = 0.25F;
  return motionWhenSelected_ + static_cast<float>(now.displacementSince(selectedAt_)) <= kStillFraction * maxSeparation;
}

void ContactCache::select(std::span<const NodePair> leafPairs, const RelativeMotion& motion,
                          std::span<const NodePair> known, RefreshPolicy refresh) {
  const bool isTooMuchAtOnce = refresh == RefreshPolicy::allIfFew && leafPairs.size() > kFewLeafPairs;
  areAllNear_ = separations_.empty() || (isDueForAll(leafPairs.size()) && !isTooMuchAtOnce);
  // Otherwise all pairs would be measured in each step from now on.
  if (isTooMuchAtOnce && isDueForAll(leafPairs.size())) measuredInVain_ = 0;
  const bool isOnlyTouching = !areAllNear_ && refresh == RefreshPolicy::touching && !known.empty();
  if (isOnlyTouching)
    near_.assign(known.begin(), known.end());
  else if (!areAllNear_)
    findNear(leafPairs, motion);
  selected_ = areAllNear_ ? leafPairs : std::span<const NodePair>(near_);
  wanted_ = selected_.size();
  const bool isTooMuch = refresh == RefreshPolicy::allIfFew && wanted_ > kFewLeafPairs;
  if (isTooMuch) selectFew(known);
  areAllSelected_ = !isOnlyTouching && !isTooMuch;
  staleness_ =
      areAllSelected_ ? 0 : motionWhenSelected_ + static_cast<float>(motion.placement.displacementSince(selectedAt_));
}

void ContactCache::allAreMeasured(const RelativeMotion& motion) {
  selectedAt_ = motion.placement;
  motionWhenSelected_ = 0;
}

// Pairs whose separation exceeded the bodies' motion since then are still separated.
void ContactCache::findNear(std::span<const NodePair> leafPairs, const RelativeMotion& motion) {
  const float near = motion.maxSeparation + static_cast<float>(motion.placement.displacementSince(measuredAt_));
  near_.clear();
  for (std::size_t i = 0; i < leafPairs.size(); ++i)
    if (separations_[i] < near) near_.push_back(leafPairs[i]);
}

// Selects the pairs in contact, and every n-th of the rest, different ones in each step. Faces that meet flat are
// noticed all over, and no pair is overlooked for long.
void ContactCache::selectFew(std::span<const NodePair> known) {
  few_.reserve(kFewLeafPairs);
  few_.assign(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(std::min(known.size(), kFewLeafPairs)));
  const std::size_t room = kFewLeafPairs - few_.size();
  const std::size_t stride = room > 0 ? (selected_.size() + room - 1) / room : 1;
  for (std::size_t i = turn_ % stride; i < selected_.size() && few_.size() < kFewLeafPairs; i += stride)
    if (std::ranges::find(known, selected_[i]) == known.end()) few_.push_back(selected_[i]);
  selected_ = few_;
  areAllNear_ = false;
}

void ContactCache::measureAll(Collider& collider, const RelativeMotion& motion, std::vector<Contact>& contacts) {
  const std::span<const NodePair> leafPairs = collider.traversal().leafPairs();
  separations_.resize(leafPairs.size());
  collider.appendContacts(leafPairs, separations_, contacts);
  measuredAt_ = motion.placement;
  allAreMeasured(motion);
  measuredInVain_ = 0;
  minSeparation_ = -kUnknown;
  isSeparationOfLeaves_ = !leafPairs.empty();
  for (const float separation : separations_) minSeparation_ = std::min(minSeparation_, separation);
}

void ContactCache::measureNear(Collider& collider, const RelativeMotion& motion, std::vector<Contact>& contacts) {
  if (areAllNear_) return measureAll(collider, motion, contacts);
  const std::size_t before = contacts.size();
  collider.appendContacts(selected_, contacts);
  measuredInVain_ += selected_.size() - std::min(selected_.size(), contacts.size() - before);
  if (areAllSelected_) allAreMeasured(motion);
  ++turn_;
}

void ContactCache::setSeparation(float separation, const RelativeMotion& motion) {
  separations_.clear();
  minSeparation_ = separation;
  isSeparationOfLeaves_ = false;
  measuredAt_ = motion.placement;
  allAreMeasured(motion);
}

void ContactCache::makeRoom(std::size_t count) {
  if (count > kFewLeafPairs) few_.reserve(kFewLeafPairs);
  if (separations_.capacity() >= count) return;
  separations_.reserve(count + count / 2);
  near_.reserve(count + count / 2);
}

void ContactCache::shrinkToFit() {
  separations_.shrink_to_fit();
  near_ = std::vector<NodePair>();
  few_ = std::vector<NodePair>();
  selected_ = {};
}

}  // namespace cairn::bullet
