// SPDX-License-Identifier: Zlib
// Pairs that lie still: what was said of them is said again.
#include "contacts/restitution.h"
#include "kernel/contact_tuning.h"
#include "pairs/tree_pair.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Where a callback or the bodies have a say in each point of each step, points are made anew.
bool isAskedAbout(const btCollisionObject& body) {
  constexpr int kOwnSay = btCollisionObject::CF_HAS_CONTACT_STIFFNESS_DAMPING |
                          btCollisionObject::CF_HAS_FRICTION_ANCHOR | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK;
  return (body.getCollisionFlags() & kOwnSay) != 0;
}

// What Bullet asks of the bodies whenever it is told a point.
void renewMaterial(btPersistentManifold& manifold) {
  const btCollisionObject *const body0 = manifold.getBody0(), *const body1 = manifold.getBody1();
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    point.m_combinedFriction = btManifoldResult::calculateCombinedFriction(body0, body1);
    point.m_combinedRestitution = btManifoldResult::calculateCombinedRestitution(body0, body1);
    point.m_combinedRollingFriction = btManifoldResult::calculateCombinedRollingFriction(body0, body1);
    point.m_combinedSpinningFriction = btManifoldResult::calculateCombinedSpinningFriction(body0, body1);
  }
}

// Users may have taken some away.
std::uint32_t pointsOf(std::span<btPersistentManifold* const> manifolds) {
  std::uint32_t points = 0;
  for (const btPersistentManifold* m : manifolds) points += m ? static_cast<std::uint32_t>(m->getNumContacts()) : 0;
  return points;
}

}  // namespace

// How far the bodies have moved against each other since, and where they are now.
std::optional<TreePair::StandsStill> TreePair::standsStill() const {
  if (!contacts_.isOfTriangles()) return {};
  if (isFast_ || wasAhead_ || isHeld_ || !isPlaced_) return {};
  if (gContactProcessedCallback || isAskedAbout(*object0()) || isAskedAbout(*object1())) return {};
  const btCollisionObjectWrapper &treeBody = treeIsBody0_ ? body0() : body1(),
                                 &otherBody = treeIsBody0_ ? body1() : body0();
  const SphereTreeShape* const tree = asSphereTree(treeBody.getCollisionShape());
  const btCollisionShape& other = *otherBody.getCollisionShape();
  if (!tree || !isSubject(*tree, asSphereTree(&other), other) || pointsOf(manifolds_) != saidContacts_) return {};
  if (!counterpart_->isUnchanged(other)) return {};
  const RelativePlacement now = relativePlacement(*tree, treeBody.getWorldTransform(), otherBody.getWorldTransform());
  const float tolerance = tuning::kCarried * speculative_;
  const auto moved = static_cast<float>(now.displacementSince(answeredAt_));
  const bool mayBounce = speedInOther(*tree, treeBody, otherBody) > static_cast<float>(slowestBounce());
  if (moved > tolerance || mayBounce) return {};
  return StandsStill{now, moved};
}

std::optional<PairReport> TreePair::carryOver() {
  const std::optional<StandsStill> still = standsStill();
  if (!still) return {};
  seenAt_ = still->placement;
  origin_ = (treeIsBody0_ ? body0() : body1()).getWorldTransform().getOrigin();
  center_ = toVec3d((treeIsBody0_ == treeIsSmaller_ ? body0() : body1()).getWorldTransform().getOrigin());
  carryPoints(true, false);
  surviveRefresh();
  for (btPersistentManifold* m : manifolds_)
    if (m) renewMaterial(*m);
  countSaid();
  PairReport report;
  report.contacts = report.exactContacts = saidContacts_;
  report.manifolds = saidManifolds_;
  report.errorFraction = heldError_ + double(still->moved / smallerSize_);
  return report;
}

}  // namespace cairn::bullet
