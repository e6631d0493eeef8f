// SPDX-License-Identifier: Zlib
// Spheres that keep bodies from each other while nothing newer is known.
#include <algorithm>

#include "pairs/pair_contacts.h"

namespace cairn::bullet {

namespace {

// How far spheres may part, as a fraction of the smaller body's size, before their guard follows: less than the reach,
// so that it stays a contact. Were it to follow what the solver's noise parts, bodies that are wedged would push each
// other ever wider.
constexpr float kUnfollowedFraction = 0.001F;

}  // namespace

// What overlaps for certain first, then the spheres of the whole bodies, then the deepest of each direction, then the
// deepest of all: what overlaps a wall must not be all that is left of the floor.
std::size_t PairContacts::putChosenFirst(std::vector<Contact>& guards) {
  std::sort(guards.begin(), guards.end(), deeper);
  std::size_t count = 0;
  const auto choose = [&](const auto& isChoice) {
    for (std::size_t i = count; i < guards.size() && count < kMaxGuards; ++i) {
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
  choose([](const Contact& c) { return c.isWhole; });
  choose([&](const Contact& c) {
    return std::none_of(guards.begin(), guards.begin() + static_cast<std::ptrdiff_t>(count),
                        [&](const Contact& chosen) { return dot(chosen.normal, c.normal) > kSameWayCosine; });
  });
  choose([](const Contact&) { return true; });
  return count;
}

void PairContacts::appendGuards(Counterpart& counterpart, const RelativeMotion& motion, float reach, Budget& budget,
                                ContactScratch& scratch) {
  const std::span<const NodePair> front = headOf(counterpart.traversal().front());
  budget.chargeAnyway(kSphereCost * static_cast<std::uint32_t>(front.size()));
  std::vector<Contact>& guards = scratch.guards;
  guards.clear();
  float closingSpeed = 0;
  for (const NodePair& pair : front) guards.push_back(counterpart.boundingContact(pair));
  // What the traversal has ruled out was apart when it was tested: after some motion only the whole bodies' spheres are
  // known to hold all of it.
  const bool isStale = traversal_.approach > kApproachFraction * motion.smallerSize;
  const bool isCut = front.size() < counterpart.traversal().front().size();
  scratch.wholes.clear();
  budget.chargeAnyway(kSphereCost * counterpart.appendWhole(scratch.wholes));
  for (const Contact& whole : scratch.wholes) {
    if (!isStale && !isCut && !lastOf(whole)) continue;
    const auto inFront = std::ranges::find(guards, whole.id, &Contact::id);
    if (inFront == guards.end())
      guards.push_back(whole);
    else
      inFront->isWhole = whole.isWhole;
  }
  for (const Contact& guard : guards) closingSpeed = std::max(closingSpeed, motion.closingSpeed(guard));
  answer_.approach += closingSpeed * motion.timeStep;
  // What was ruled out may close in while the front stands still: a rod that turns about its end.
  traversal_.approach += motion.greatestSpeed() * motion.timeStep;
  std::erase_if(guards, [&](const Contact& c) { return c.certainDepth <= 0 && !isWanted(c, motion, reach); });
  const std::size_t count = putChosenFirst(guards);
  std::array<Guard, kMaxGuards> now;
  for (std::size_t i = 0; i < count; ++i) {
    const float allowed = allowedGap(guards[i], motion.smallerSize);
    // What it forgives is what spheres hold beyond the bodies: not how far these overlap for certain.
    guards[i].gap -= allowed;
    if (guards[i].certainDepth > 0) guards[i].gap = std::min(guards[i].gap, -guards[i].certainDepth);
    now[i] = {guards[i].id, guards[i].isWhole, guards[i].normal, allowed, std::max(-guards[i].gap, 0.0F)};
    guards[i].isGuard = true;
    scratch.contacts.list().push_back(guards[i]);
  }
  guards_.assign(now.begin(), now.begin() + count);
  budget.chargeAnyway(kContactCost * counterpart.appendCoarse(scratch.contacts.list()));
}

// The same guard in the last step. Of whole bodies it is the one that faced the same way, whatever is nearest now: one
// for the floor says nothing about a wall.
const PairContacts::Guard* PairContacts::lastOf(const Contact& guard) const {
  const Guard* best = nullptr;
  float cosine = kSameWayCosine;
  for (const Guard& g : guards_) {
    const float c = dot(g.normal, guard.normal);
    if (!guard.isWhole || !g.isWhole || c <= cosine) continue;
    best = &g;
    cosine = c;
  }
  if (best) return best;
  const auto same = std::ranges::find(guards_, guard.id, &Guard::id);
  return same == guards_.end() ? nullptr : &*same;
}

// Where a guard is first seen it has depth zero. The solver only slows what has depth zero, so a guard remembers where
// it was and reports what its spheres have sunk since; when they part, it follows, all but a little. Where refinement
// has replaced the spheres by finer ones, those inherit what the guards that faced the same way had sunk: else every
// step of a slow traversal would start anew from zero, and bodies creep through each other.
float PairContacts::allowedGap(const Contact& guard, float smallerSize) const {
  const float now = std::min(guard.gap, 0.0F);
  if (const Guard* last = lastOf(guard)) return std::max(last->allowedGap, now - kUnfollowedFraction * smallerSize);
  float sunk = 0;
  for (const Guard& g : guards_) {
    if (dot(g.normal, guard.normal) > kSameWayCosine) sunk = std::max(sunk, g.sunk);
  }
  return now + sunk;
}

// Velocities do not tell everything: the solver also shifts bodies to part others.
bool PairContacts::isWanted(const Contact& guard, const RelativeMotion& motion, float reach) const {
  if (guard.gap >= reach) return false;
  const Vec3 moved = motion.treeCenter - motion.otherCenter - answer_.centers;
  return !hasAnswer(motion) || -dot(guard.normal, moved) > kApproachFraction * motion.smallerSize;
}

bool PairContacts::isGuardedWithin(float moved, float smallerSize) const {
  return !guards_.empty() && traversal_.approach + moved <= kHeldFraction * smallerSize;
}

Contact PairContacts::holdWhole(Contact whole, float smallerSize) {
  const float allowed = allowedGap(whole, smallerSize);
  const Guard* const last = lastOf(whole);
  whole.gap -= allowed;
  whole.isGuard = true;
  const Guard guard{whole.id, true, whole.normal, allowed, std::max(-whole.gap, 0.0F)};
  if (last)
    guards_[static_cast<std::size_t>(last - guards_.data())] = guard;
  else if (guards_.size() < kMaxGuards)
    guards_.push_back(guard);
  else
    guards_.back() = guard;
  return whole;
}

}  // namespace cairn::bullet
