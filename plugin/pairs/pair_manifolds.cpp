// SPDX-License-Identifier: Zlib
#include "pairs/pair_manifolds.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <algorithm>
#include <limits>

#include "contacts/manifold_writer.h"
#include "pairs/body_motion.h"
#include "platform/prefetch.h"

namespace cairn::bullet {

namespace {

// Seconds at rest before Bullet puts bodies to sleep, by default (`gDeactivationTime` of btRigidBody, which is not in
// its collision library). Bodies that want to sleep earlier were told to by the user.
constexpr btScalar kPatience = 2;

// Bullet's `refreshContactPoints` drops a point whose two sides slide apart. Here it stays, as a plane through the
// point on body 1, because no new point is searched in this step. `turned`: rotation of body 1 since the last call.
// Points farther apart than `farthest` are dropped.
void followBodies(btPersistentManifold& manifold, const btMatrix3x3& turned, btScalar farthest) {
  const btTransform& pose0 = manifold.getBody0()->getWorldTransform();
  const btTransform& pose1 = manifold.getBody1()->getWorldTransform();
  for (int i = manifold.getNumContacts() - 1; i >= 0; --i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    const btVector3 normal = (turned * point.m_normalWorldOnB).normalized();
    point.m_normalWorldOnB = normal;
    point.m_positionWorldOnA = pose0 * point.m_localPointA;
    point.m_positionWorldOnB = pose1 * point.m_localPointB;
    point.m_distance1 = (point.m_positionWorldOnA - point.m_positionWorldOnB).dot(normal);
    if ((point.m_contactPointFlags & BT_CONTACT_FLAG_FRICTION_ANCHOR) == 0) {
      point.m_positionWorldOnB = point.m_positionWorldOnA - normal * point.m_distance1;
      point.m_localPointB = pose1.invXform(point.m_positionWorldOnB);
    }
    ++point.m_lifeTime;
    if (point.m_distance1 > farthest) manifold.removeContactPoint(i);
  }
}

void renewMaterial(btManifoldPoint& point, const btCollisionObject* body0, const btCollisionObject* body1) {
  point.m_combinedFriction = btManifoldResult::calculateCombinedFriction(body0, body1);
  point.m_combinedRestitution = btManifoldResult::calculateCombinedRestitution(body0, body1);
  point.m_combinedRollingFriction = btManifoldResult::calculateCombinedRollingFriction(body0, body1);
  point.m_combinedSpinningFriction = btManifoldResult::calculateCombinedSpinningFriction(body0, body1);
}

bool isLoadedGuard(const btManifoldPoint& point) {
  return isGuard(point) && (point.m_appliedImpulse > 0 || point.m_lifeTime == 0);
}

// Calls `visit` with each point and its manifold.
template <class OnPoint>
void forEachPoint(std::span<btPersistentManifold* const> manifolds, const OnPoint& onPoint) {
  for (btPersistentManifold* m : manifolds)
    for (int i = 0; m && i < m->getNumContacts(); ++i) onPoint(m->getContactPoint(i), *m);
}

}  // namespace

btPersistentManifold* PairManifolds::make(int cluster, btDispatcher& dispatcher, btScalar farthest) {
  btPersistentManifold*& m = manifolds_[static_cast<std::size_t>(cluster)];
  if (!m) {
    m = dispatcher.getNewManifold(bodies_[0], bodies_[1]);
    if (m) prefetch(m + 1, sizeof(btPersistentManifold));  // the next one, while Bullet's pool is in order
  }
  if (m) m->setContactBreakingThreshold(farthest);
  return m;
}

void PairManifolds::append(btManifoldArray& manifolds) const {
  for (btPersistentManifold* m : manifolds_)
    if (m) manifolds.push_back(m);
}

void PairManifolds::release(btDispatcher& dispatcher) {
  for (btPersistentManifold*& m : manifolds_) {
    if (m) dispatcher.releaseManifold(m);
    m = nullptr;
  }
}

void PairManifolds::clear() {
  for (btPersistentManifold* m : manifolds_)
    if (m && m->getNumContacts() > 0) m->clearManifold();
}

std::uint32_t PairManifolds::countPoints() const {
  std::uint32_t points = 0;
  for (const btPersistentManifold* m : manifolds_) points += m ? static_cast<std::uint32_t>(m->getNumContacts()) : 0;
  return points;
}

std::uint32_t PairManifolds::countFilled() const {
  const auto isFilled = [](const btPersistentManifold* m) { return m && m->getNumContacts() > 0; };
  return static_cast<std::uint32_t>(std::ranges::count_if(manifolds_, isFilled));
}

bool PairManifolds::areOfNonFinite() const {
  return std::ranges::any_of(manifolds_, [](const btPersistentManifold* m) {
    return m && m->getNumContacts() > 0 && (isNonFinite(*m->getBody0()) || isNonFinite(*m->getBody1()));
  });
}

void PairManifolds::follow(std::optional<btScalar> farthest, bool keepsFallback) {
  const btMatrix3x3& axes = bodies_[1]->getWorldTransform().getBasis();
  // Skipped without rotation: rounding would accumulate step by step.
  const btMatrix3x3 turned = axes == axes_ ? btMatrix3x3::getIdentity() : axes * axes_.transpose();
  constexpr btScalar kAnywhere = std::numeric_limits<btScalar>::max();
  for (int k = 0; k < kMaxClusters; ++k) {
    const bool keepsAll = keepsFallback && k == fallback_;
    if (btPersistentManifold* const m = at(k))
      followBodies(*m, turned, keepsAll ? kAnywhere : farthest.value_or(kAnywhere));
  }
  axes_ = axes;
}

void PairManifolds::surviveRefresh(btScalar farthest) {
  for (btPersistentManifold* m : manifolds_)
    if (m) m->setContactBreakingThreshold(farthest);
}

void PairManifolds::renewMaterials() {
  forEachPoint(manifolds_, [](btManifoldPoint& point, const btPersistentManifold& m) {
    renewMaterial(point, m.getBody0(), m.getBody1());
  });
}

void PairManifolds::unlock() {
  for (btPersistentManifold* m : manifolds_)
    for (int i = m ? m->getNumContacts() : 0; i-- > 0;) {
      btManifoldPoint& point = m->getContactPoint(i);
      if ((point.m_contactPointFlags & kLockedFlag) == 0) continue;
      const bool isOpposite = (point.m_contactPointFlags & kOppositeFlag) != 0;
      point.m_contactPointFlags &= ~kLockedFlag;
      if (isOpposite)
        m->removeContactPoint(i);
      else
        renewMaterial(point, m->getBody0(), m->getBody1());
    }
}

void PairManifolds::forgetImpulses() {
  forEachPoint(manifolds_, [](btManifoldPoint& point, const auto&) { point.m_appliedImpulse = 0; });
}

void PairManifolds::chooseFallback(bool amongFullest) {
  if (hasFallback()) return;
  const int sign = amongFullest ? -1 : 1;
  const auto points = [&](const btPersistentManifold* m) { return m ? sign * m->getNumContacts() : 0; };
  fallback_ = static_cast<int>(std::ranges::min_element(manifolds_, {}, points) - manifolds_.begin());
}

void PairManifolds::clearOthers() {
  for (int k = 0; k < kMaxClusters; ++k)
    if (btPersistentManifold* const m = at(k); m && k != fallback_ && m->getNumContacts() > 0) m->clearManifold();
}

bool PairManifolds::areGuardsLoaded() const {
  bool areLoaded = false;
  forEachPoint(manifolds_, [&](const btManifoldPoint& p, const auto&) { areLoaded = areLoaded || isLoadedGuard(p); });
  return areLoaded;
}

const btManifoldPoint* PairManifolds::mostLoaded() const {
  const btManifoldPoint* most = nullptr;
  forEachPoint(manifolds_, [&](const btManifoldPoint& p, const auto&) {
    if (!most || p.m_appliedImpulse > most->m_appliedImpulse) most = &p;
  });
  return most;
}

void PairManifolds::stayAwake() const {
  if (!bodies_[0]->hasContactResponse() || !bodies_[1]->hasContactResponse()) return;
  for (const btCollisionObject* body : bodies_) {
    const int state = body->getActivationState();
    const bool isTired = state == WANTS_DEACTIVATION && body->getDeactivationTime() > kPatience;
    if (state == ACTIVE_TAG || isTired) body->activate();
  }
}

void PairManifolds::prefetchCounts() const {
  for (const btPersistentManifold* m : manifolds_)
    if (m) prefetch(&m->m_companionIdA, sizeof(int));  // the number of points is stored beside it
}

void PairManifolds::prefetchPoints() const {
  for (const btPersistentManifold* m : manifolds_)
    if (m) prefetch(m, static_cast<std::size_t>(m->getNumContacts()) * sizeof(btManifoldPoint));
}

}  // namespace cairn::bullet
