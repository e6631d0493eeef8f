// SPDX-License-Identifier: Zlib
// Of a pair that is not resolved: which spheres may be guards.
#include <algorithm>

#include "pairs/pair_contacts.h"

namespace cairn::bullet {

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
  const bool isStale = !age_.isTraversalRecent(motion.smallerSize);
  const bool isCut = front.size() < counterpart.traversal().front().size();
  scratch.wholes.clear();
  budget.chargeAnyway(kSphereCost * counterpart.appendWhole(scratch.wholes));
  for (const Contact& whole : scratch.wholes) {
    if (!isStale && !isCut && !guards_.had(whole)) continue;
    const auto inFront = std::ranges::find(guards, whole.id, &Contact::id);
    if (inFront == guards.end())
      guards.push_back(whole);
    else
      inFront->isWhole = whole.isWhole;
  }
  for (const Contact& guard : guards) closingSpeed = std::max(closingSpeed, motion.closingSpeed(guard));
  // What was ruled out may close in while the front stands still: a rod that turns about its end.
  age_.approached(closingSpeed * motion.timeStep, motion.greatestSpeed() * motion.timeStep);
  std::erase_if(guards, [&](const Contact& c) { return c.certainDepth <= 0 && !isWanted(c, motion, reach); });
  guards_.choose(guards, motion.smallerSize, scratch.contacts.list());
  budget.chargeAnyway(kContactCost * counterpart.appendCoarse(scratch.contacts.list()));
}

// Velocities do not tell everything: the solver also shifts bodies to part others.
bool PairContacts::isWanted(const Contact& guard, const RelativeMotion& motion, float reach) const {
  if (guard.gap >= reach) return false;
  const Vec3 centers = motion.treeCenter - motion.otherCenter;
  return !hasAnswer(motion) || age_.haveClosed(centers, guard.normal, motion.smallerSize);
}

}  // namespace cairn::bullet
