// SPDX-License-Identifier: Zlib
#include "contacts/friction_anchor.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <limits>

namespace cairn::bullet {

std::optional<FrictionAnchor> FrictionAnchor::of(const btManifoldPoint& point) {
  if ((point.m_contactPointFlags & BT_CONTACT_FLAG_FRICTION_ANCHOR) == 0) return std::nullopt;
  const btVector3 lateral(point.m_appliedImpulseLateral1, point.m_appliedImpulseLateral2, 0);
  const btScalar most = point.m_combinedFriction * point.m_appliedImpulse;
  if (lateral.length2() > most * most) return std::nullopt;
  FrictionAnchor anchor;
  anchor.local0_ = point.m_localPointA;
  anchor.local1_ = point.m_localPointB;
  anchor.lateralImpulse1_ = point.m_appliedImpulseLateral1;
  anchor.lateralImpulse2_ = point.m_appliedImpulseLateral2;
  return anchor;
}

// No friction holds that.
void FrictionAnchor::release(btManifoldPoint& point) {
  point.m_appliedImpulseLateral1 = std::numeric_limits<btScalar>::max();
}

void FrictionAnchor::hold(const btPersistentManifold& manifold, btManifoldPoint& point) const {
  point.m_appliedImpulseLateral1 = lateralImpulse1_;
  point.m_appliedImpulseLateral2 = lateralImpulse2_;
  if ((point.m_contactPointFlags & BT_CONTACT_FLAG_FRICTION_ANCHOR) == 0) return;
  const btTransform& pose0 = manifold.getBody0()->getWorldTransform();
  const btTransform& pose1 = manifold.getBody1()->getWorldTransform();
  const btVector3& normal = point.m_normalWorldOnB;
  // Both into the plane that lies as this step's points do: they were at the surface when they met.
  btVector3 on0 = pose0 * local0_, on1 = pose1 * local1_;
  on0 -= normal * (on0 - point.m_positionWorldOnA).dot(normal);
  on1 -= normal * (on1 - point.m_positionWorldOnB).dot(normal);
  const btVector3 apart = on0 - on1;
  const btVector3 slid = apart - normal * apart.dot(normal);
  const btScalar most = manifold.getContactBreakingThreshold();
  if (slid.length2() > most * most || (on0 - point.m_positionWorldOnA).length2() > most * most) return;
  point.m_positionWorldOnA = on0;
  point.m_positionWorldOnB = on1;
  point.m_localPointA = pose0.invXform(on0);
  point.m_localPointB = pose1.invXform(on1);
}

}  // namespace cairn::bullet
