// SPDX-License-Identifier: Zlib
#include "pairs/pair_guards.h"

#include <algorithm>
#include <array>

#include "contacts/normal_clusters.h"

namespace cairn::bullet {

namespace {

// How far guard spheres may separate before the guard follows, as a fraction of the smaller body's size. It is less
// than the contact distance, so that the guard remains a contact. If guards followed the solver's noise, wedged bodies
// would push each other apart.
constexpr float kUnfollowedFraction = 0.001F;

// Distance between a guard's point and its opposite's, as a fraction of the smaller body's size: so far apart that
// neither Bullet nor the choice of contacts takes both for one (`LinkedRings.StayLinkedOnASmallBudget`).
constexpr float kOppositeFraction = 0.1F;

// Order of importance: certain overlaps, root contacts, the deepest contact of each direction, the deepest of all.
// Overlaps with a wall must not displace the floor's.
std::size_t putChosenFirst(std::vector<Contact>& guards) {
  std::sort(guards.begin(), guards.end(), deeper);
  std::size_t count = 0;
  const auto choose = [&](const auto& isChoice) {
    for (std::size_t i = count; i < guards.size() && count < PairGuards::kMax; ++i) {
      if (!isChoice(guards[i])) continue;
      const auto first = guards.begin() + static_cast<std::ptrdiff_t>(count);
      const auto it = guards.begin() + static_cast<std::ptrdiff_t>(i);
      std::rotate(first, it, it + 1);
      ++count;
    }
  };
  const auto certain = std::ranges::max_element(guards, {}, &Contact::certainDepth);
  if (certain != guards.end() && certain->certainDepth > 0) {
    std::rotate(guards.begin(), certain, certain + 1);
    ++count;
  }
  choose([](const Contact& c) { return c.isRootContact; });
  choose([&](const Contact& c) {
    return std::none_of(guards.begin(), guards.begin() + static_cast<std::ptrdiff_t>(count),
                        [&](const Contact& chosen) { return dot(chosen.normal, c.normal) > kSameMotionCosine; });
  });
  choose([](const Contact&) { return true; });
  return count;
}

}  // namespace

PairGuards::Guard PairGuards::noted(const Contact& guard, float allowedSeparation) {
  return {guard.id, guard.isRootContact, guard.normal, allowedSeparation, std::max(-guard.separation, 0.0F)};
}

void PairGuards::choose(std::vector<Contact>& candidates, float smallerSize, std::vector<Contact>& contacts) {
  const std::size_t count = putChosenFirst(candidates);
  std::array<Guard, kMax> now;
  for (std::size_t i = 0; i < count; ++i) {
    Contact& guard = candidates[i];
    const float allowed = allowedSeparation(guard, smallerSize);
    // A guard tolerates the overlap of spheres beyond the bodies, but not a certain overlap.
    guard.separation -= allowed;
    if (guard.certainDepth > 0) guard.separation = std::min(guard.separation, -guard.certainDepth);
    now[i] = noted(guard, allowed);
    guard.isGuard = true;
    lockGuard(guard);
    contacts.push_back(guard);
    if (isLocked_) contacts.push_back(oppositeOf(guard, smallerSize));
  }
  guards_.assign(now.begin(), now.begin() + count);
}

// The same guard in the last step. For a root contact it is the one with a similar normal, whatever is nearest now: a
// guard for the floor says nothing about a wall.
const PairGuards::Guard* PairGuards::lastOf(const Contact& guard) const {
  const Guard* best = nullptr;
  float cosine = kSameMotionCosine;
  for (const Guard& g : guards_) {
    const float c = dot(g.normal, guard.normal);
    if (!guard.isRootContact || !g.isRootContact || c <= cosine) continue;
    best = &g;
    cosine = c;
  }
  if (best) return best;
  const auto same = std::ranges::find(guards_, guard.id, &Guard::id);
  return same == guards_.end() ? nullptr : &*same;
}

// A new guard has depth zero, at which the solver only slows the bodies. So the guard remembers its first overlap and
// reports the overlap gained since. When the spheres separate, it follows all but a little. Finer spheres inherit the
// overlap of guards with similar normals: otherwise every step of a slow traversal would start at zero, and bodies
// would creep through each other.
float PairGuards::allowedSeparation(const Contact& guard, float smallerSize) const {
  const float now = std::min(guard.separation, 0.0F);
  if (const Guard* last = lastOf(guard))
    return std::max(last->allowedSeparation, now - kUnfollowedFraction * smallerSize);
  float sunk = 0;
  for (const Guard& g : guards_) {
    if (dot(g.normal, guard.normal) > kSameMotionCosine) sunk = std::max(sunk, g.sunk);
  }
  return now + sunk;
}

// Depth would push against the opposite. Both points on one place: friction then keeps angular momentum.
void PairGuards::lockGuard(Contact& guard) const {
  if (!isLocked_) return;
  guard.lock = Lock::guard;
  guard.separation = std::max(guard.separation, 0.0F);
}

// A constraint acts the same anywhere on the line of its normal.
Contact PairGuards::oppositeOf(const Contact& guard, float smallerSize) {
  Contact opposite = guard;
  opposite.lock = Lock::opposite;
  opposite.position += guard.normal * (kOppositeFraction * smallerSize);
  opposite.normal = -guard.normal;
  opposite.separation = 0;
  opposite.certainDepth = 0;
  return opposite;
}

Contact PairGuards::guardByRoot(Contact whole, float smallerSize) {
  const float allowed = allowedSeparation(whole, smallerSize);
  const Guard* const last = lastOf(whole);
  whole.separation -= allowed;
  whole.isGuard = whole.isRootContact = true;
  lockGuard(whole);
  const Guard guard = noted(whole, allowed);
  if (last)
    guards_[static_cast<std::size_t>(last - guards_.data())] = guard;
  else if (guards_.size() < kMax)
    guards_.push_back(guard);
  else
    guards_.back() = guard;
  return whole;
}

}  // namespace cairn::bullet
