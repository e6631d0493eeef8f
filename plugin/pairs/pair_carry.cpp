// SPDX-License-Identifier: Zlib
#include "pairs/pair_carry.h"

#include "contacts/restitution.h"
#include "kernel/contact_tuning.h"

namespace cairn::bullet {

namespace {

// Where a callback or the bodies have a say in each point of each step, points are made anew.
bool isAskedAbout(const btCollisionObject& body) {
  constexpr int kOwnSay = btCollisionObject::CF_HAS_CONTACT_STIFFNESS_DAMPING |
                          btCollisionObject::CF_HAS_FRICTION_ANCHOR | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK;
  return (body.getCollisionFlags() & kOwnSay) != 0;
}

}  // namespace

std::optional<StandsStill> standsStill(const TreePair& pair) {
  if (!pair.contacts.isOfTriangles()) return {};
  if (pair.course.isFast || pair.said.wasAhead || pair.age.isHeld || !pair.age.isPlaced) return {};
  if (gContactProcessedCallback || isAskedAbout(*pair.bodies.object0()) || isAskedAbout(*pair.bodies.object1()))
    return {};
  const PairSides sides = pair.sides();
  const SphereTreeShape* const tree = sides.shape();
  if (!tree || !pair.subject.is(*tree, sides.otherShape()) || pair.manifolds.countPoints() != pair.said.contacts)
    return {};
  if (!pair.counterpart->isUnchanged(sides.otherShape())) return {};
  const RelativePlacement now = PairMotion::placementOf(sides);
  const auto moved = static_cast<float>(now.displacementSince(pair.age.answeredAt));
  const bool mayBounce = PairMotion::speedInOther(sides) > static_cast<float>(slowestBounce());
  if (moved > tuning::kCarried * pair.sizes.speculative || mayBounce) return {};
  return StandsStill{now, moved};
}

PairReport carryOver(TreePair& pair, const StandsStill& still) {
  pair.motion.seenAt = still.placement;
  pair.motion.follow(pair.sides(), pair.sizes);
  pair.manifolds.follow(pair.breakingThreshold(), false);
  pair.surviveRefresh();
  pair.manifolds.renewMaterials();
  pair.countSaid();
  PairReport report;
  report.contacts = report.exactContacts = pair.said.contacts;
  report.manifolds = pair.said.manifolds;
  report.errorFraction = pair.age.error + pair.sizes.fraction(still.moved);
  return report;
}

}  // namespace cairn::bullet
