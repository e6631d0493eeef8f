// SPDX-License-Identifier: Zlib
#include "pairs/pair_reuse.h"

#include "contacts/restitution.h"
#include "kernel/contact_tuning.h"

namespace cairn::bullet {

namespace {

// Points are made anew where callbacks or the bodies must see each point in each step.
bool isAskedAbout(const btCollisionObject& body) {
  constexpr int kOwnSay = btCollisionObject::CF_HAS_CONTACT_STIFFNESS_DAMPING |
                          btCollisionObject::CF_HAS_FRICTION_ANCHOR | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK;
  return (body.getCollisionFlags() & kOwnSay) != 0;
}

}  // namespace

std::optional<Unmoved> unmoved(const TreePair& pair) {
  if (!pair.contacts.isOfTriangles()) return {};
  if (pair.trajectory.isFast || pair.reported.wasSpeculative || pair.age.isCarriedOver || !pair.age.isPlaced) return {};
  if (gContactProcessedCallback || isAskedAbout(*pair.bodies.object0()) || isAskedAbout(*pair.bodies.object1()))
    return {};
  const PairSides sides = pair.sides();
  const SphereTreeShape* const tree = sides.shape();
  if (!tree || !pair.subject.is(*tree, sides.otherShape()) || pair.manifolds.countPoints() != pair.reported.contacts)
    return {};
  if (!pair.collider->isUnchanged(sides.otherShape())) return {};
  const RelativePlacement now = PairMotion::placementOf(sides);
  const auto moved = static_cast<float>(now.displacementSince(pair.age.answeredAt));
  const bool mayBounce = PairMotion::speedInOther(sides) > static_cast<float>(slowestBounce());
  if (moved > tuning::kReused * pair.sizes.speculative || mayBounce) return {};
  return Unmoved{now, moved};
}

PairReport reuse(TreePair& pair, const Unmoved& still) {
  pair.motion.seenAt = still.placement;
  pair.motion.follow(pair.sides(), pair.sizes);
  pair.manifolds.follow(pair.breakingThreshold(), false);
  pair.surviveRefresh();
  pair.manifolds.renewMaterials();
  pair.countReported();
  PairReport report;
  report.contacts = report.exactContacts = pair.reported.contacts;
  report.manifolds = pair.reported.manifolds;
  report.errorFraction = pair.age.error + pair.sizes.fraction(still.moved);
  return report;
}

}  // namespace cairn::bullet
