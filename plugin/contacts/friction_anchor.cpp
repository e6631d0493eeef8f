// SPDX-License-Identifier: Zlib
#include "contacts/friction_anchor.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <cmath>
#include <initializer_list>

namespace cairn::bullet {

namespace {

bool isAnchored(const btManifoldPoint& point) {
  return (point.m_contactPointFlags & BT_CONTACT_FLAG_FRICTION_ANCHOR) != 0;
}

bool isWithinCone(const btManifoldPoint& point) {
  const btVector3 lateral(point.m_appliedImpulseLateral1, point.m_appliedImpulseLateral2, 0);
  const btScalar maxFriction = point.m_combinedFriction * point.m_appliedImpulse;
  return lateral.length2() <= maxFriction * maxFriction;
}

}  // namespace

bool FrictionAnchor::isAskedFor(const btPersistentManifold& manifold) {
  const int flags = manifold.getBody0()->getCollisionFlags() | manifold.getBody1()->getCollisionFlags();
  return (flags & btCollisionObject::CF_HAS_FRICTION_ANCHOR) != 0;
}

FrictionAnchor::FrictionAnchor(const btManifoldPoint& point)
    : holds_(isAnchored(point) && isWithinCone(point)),
      local0_(point.m_localPointA),
      local1_(point.m_localPointB),
      impulse_(point.m_appliedImpulse),
      lateralImpulse1_(point.m_appliedImpulseLateral1),
      lateralImpulse2_(point.m_appliedImpulseLateral2) {}

// Makes Bullet replace the point: Bullet keeps only points whose friction lies within their cone. The impulses stay,
// because callbacks read them.
void FrictionAnchor::release(btManifoldPoint& point) {
  constexpr auto kMinPull = btScalar(1e-18);  // its square does not underflow
  point.m_combinedFriction = 0;
  for (btScalar* impulse : {&point.m_appliedImpulse, &point.m_appliedImpulseLateral1, &point.m_appliedImpulseLateral2})
    if (!std::isfinite(*impulse)) *impulse = 0;
  const btVector3 lateral(point.m_appliedImpulseLateral1, point.m_appliedImpulseLateral2, 0);
  if (lateral.length2() == 0) point.m_appliedImpulseLateral1 = kMinPull;
}

void FrictionAnchor::restore(const btPersistentManifold& manifold, btManifoldPoint& point) const {
  point.m_appliedImpulse = impulse_;
  point.m_appliedImpulseLateral1 = lateralImpulse1_;
  point.m_appliedImpulseLateral2 = lateralImpulse2_;
  if (holds_ && isAnchored(point)) hold(manifold, point);
}

void FrictionAnchor::hold(const btPersistentManifold& manifold, btManifoldPoint& point) const {
  const btTransform& pose0 = manifold.getBody0()->getWorldTransform();
  const btTransform& pose1 = manifold.getBody1()->getWorldTransform();
  const btVector3& normal = point.m_normalWorldOnB;
  // Both held points lie on this step's contact plane, so that the depth is this step's.
  btVector3 on0 = pose0 * local0_, on1 = pose1 * local1_;
  on0 -= normal * (on0 - point.m_positionWorldOnA).dot(normal);
  on1 -= normal * (on1 - point.m_positionWorldOnB).dot(normal);
  const btVector3 separationVector = on0 - on1;
  const btVector3 slid = separationVector - normal * separationVector.dot(normal);
  const btScalar maxSlide = manifold.getContactBreakingThreshold();
  if (slid.length2() > maxSlide * maxSlide || (on0 - point.m_positionWorldOnA).length2() > maxSlide * maxSlide) return;
  point.m_positionWorldOnA = on0;
  point.m_positionWorldOnB = on1;
  point.m_localPointA = pose0.invXform(on0);
  point.m_localPointB = pose1.invXform(on1);
}

}  // namespace cairn::bullet
