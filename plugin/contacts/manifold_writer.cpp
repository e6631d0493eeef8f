// SPDX-License-Identifier: Zlib
#include "contacts/manifold_writer.h"

#include <limits>
#include <utility>

#include "contacts/friction_anchor.h"
#include "contacts/restitution.h"
#include "contacts/solving_order.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

// Maps each chosen contact to the old point of the manifold that it continues, and back; -1 for none.
struct ManifoldWriter::Matching {
  std::array<int, kMaxPoints> oldOf{-1, -1, -1, -1};
  std::array<int, kMaxPoints> choiceOf{-1, -1, -1, -1};
  std::array<btVector3, kMaxPoints> local;  // of the chosen contacts, in body 0's frame

  void join(std::size_t choice, int old) {
    oldOf[choice] = old;
    choiceOf[static_cast<std::size_t>(old)] = static_cast<int>(choice);
  }
  bool isOldFree(int old) const { return choiceOf[static_cast<std::size_t>(old)] < 0; }
  bool isNew(std::size_t choice) const { return oldOf[choice] < 0; }
};

namespace {

ContactId idOf(const btManifoldPoint& p, bool treeIsBody0) {
  if (treeIsBody0) return {p.m_partId0, p.m_index0, p.m_partId1, p.m_index1};
  return {p.m_partId1, p.m_index1, p.m_partId0, p.m_index0};
}

// Marks a point that no contact of this step has replaced yet.
constexpr btScalar kUnreported = std::numeric_limits<btScalar>::infinity();

// Marks the points that were in the manifold before Bullet adds one: a callback may change any other property of the
// new point. Bullet does not use this flag.
constexpr int kExistingPoint = 1 << 30;

// Coefficient of friction of points that must not slide: more than surfaces have. With the bodies' own, three times as
// many rings turn through each other (`LinkedRings.StayLinkedOnASmallBudget`).
constexpr btScalar kLockedFriction = 10;

void lock(btManifoldPoint& point, Lock as) {
  point.m_combinedFriction = kLockedFriction;
  point.m_contactPointFlags |= as == Lock::opposite ? kLockedFlag | kOppositeFlag : kLockedFlag;
}

// Recomputes a point that a callback changed. For Bullet's own shapes, `refreshContactPoints` does this after the
// callback. So the local points and the normal count; the world positions and the distance follow from them.
void refresh(const btPersistentManifold& manifold, btManifoldPoint& point) {
  point.m_positionWorldOnA = manifold.getBody0()->getWorldTransform()(point.m_localPointA);
  point.m_positionWorldOnB = manifold.getBody1()->getWorldTransform()(point.m_localPointB);
  point.m_distance1 = (point.m_positionWorldOnA - point.m_positionWorldOnB).dot(point.m_normalWorldOnB);
}

using Anchors = std::array<FrictionAnchor, kMaxPoints>;

// Removes continued points that no contact replaced. Two contacts that round to one place replace one old point twice
// and leave the other where it was a step ago. Returns how many of the first `continued` points remain; they stay
// first.
int dropUnreported(btPersistentManifold& manifold, int continued, Anchors& anchors) {
  for (int i = continued - 1; i >= 0; --i) {
    if (manifold.getContactPoint(i).m_distance1 != kUnreported) continue;
    --continued;
    std::swap(manifold.getContactPoint(i), manifold.getContactPoint(continued));
    std::swap(anchors[static_cast<std::size_t>(i)], anchors[static_cast<std::size_t>(continued)]);
    manifold.removeContactPoint(continued);
  }
  return continued;
}

}  // namespace

ManifoldContacts contactsIn(const btPersistentManifold& manifold, bool treeIsBody0) {
  ManifoldContacts ids;
  for (int i = 0; i < manifold.getNumContacts(); ++i)
    ids.id[static_cast<std::size_t>(ids.count++)] = idOf(manifold.getContactPoint(i), treeIsBody0);
  return ids;
}

btVector3 ManifoldWriter::localOnBody0(const btPersistentManifold& manifold, const Contact& contact) const {
  const Vec3 onBody0 = treeIsBody0_ ? contact.onTree() : contact.onCollider();
  return manifold.getBody0()->getWorldTransform().invXform(origin_ + toBullet(onBody0));
}

// Continues the nearest free old point that is near enough, if any. One id may stand for several points.
template <class MayJoin>
void ManifoldWriter::joinNearest(Matching& matching, const btPersistentManifold& manifold, std::size_t choice,
                                 btScalar nearestSq, const MayJoin& mayJoin) {
  int nearest = -1;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    if (!matching.isOldFree(i) || !mayJoin(i)) continue;
    const btVector3& local = matching.local[choice];
    const btScalar distanceSq = (manifold.getContactPoint(i).m_localPointA - local).length2();
    if (distanceSq >= nearestSq) continue;
    nearest = i;
    nearestSq = distanceSq;
  }
  if (nearest >= 0) matching.join(choice, nearest);
}

// Matches by place before id. A face's corners carry the ids of the leaves that reported them: several may share one
// id, and the ids change from step to step. Matched by id alone, points at rest would take each other's impulses.
ManifoldWriter::Matching ManifoldWriter::match(const btPersistentManifold& manifold,
                                               std::span<const Contact> chosen) const {
  Matching matching;
  const ManifoldContacts old = contactsIn(manifold, treeIsBody0_);
  const btScalar near = btScalar(inheritance_) * btScalar(inheritance_);
  const auto join = [&](btScalar nearestSq, bool byId) {
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const auto mayJoin = [&](int i) { return !byId || old.id[static_cast<std::size_t>(i)] == chosen[k].id; };
      if (matching.isNew(k)) joinNearest(matching, manifold, k, nearestSq, mayJoin);
    }
  };
  for (std::size_t k = 0; k < chosen.size(); ++k) matching.local[k] = localOnBody0(manifold, chosen[k]);
  join(near, true);
  join(near, false);
  join(SIMD_INFINITY, true);
  return matching;
}

void ManifoldWriter::write(btPersistentManifold& manifold, std::span<const Contact> chosen) {
  Matching matching = match(manifold, chosen);
  bool anyContinues = false;
  for (std::size_t k = 0; k < chosen.size(); ++k) anyContinues = anyContinues || !matching.isNew(k);
  if (!chosen.empty() && !anyContinues && manifold.getNumContacts() > 0) {
    // The contact moved, but has not ended: one point stays, without its impulse, so that Bullet does not report an end
    // and a start.
    manifold.getContactPoint(0).m_appliedImpulse = 0;
    matching.join(0, 0);
  }
  for (int i = manifold.getNumContacts() - 1; i >= 0; --i) {
    if (!matching.isOldFree(i)) continue;
    manifold.removeContactPoint(i);  // moves the last point to i
    const int last = manifold.getNumContacts();
    matching.choiceOf[static_cast<std::size_t>(i)] = matching.choiceOf[static_cast<std::size_t>(last)];
    matching.choiceOf[static_cast<std::size_t>(last)] = -1;
  }
  int continued = manifold.getNumContacts();
  const bool mayBeAnchored = FrictionAnchor::isAskedFor(manifold);
  Anchors anchors;
  for (int i = 0; i < continued; ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    if (mayBeAnchored) {
      anchors[static_cast<std::size_t>(i)] = FrictionAnchor(point);
      FrictionAnchor::release(point);
    }
    point.m_localPointA = matching.local[static_cast<std::size_t>(matching.choiceOf[static_cast<std::size_t>(i)])];
    point.m_distance1 = kUnreported;
    ++point.m_lifeTime;
  }
  for (const Contact& contact : chosen) add(manifold, contact);
  continued = dropUnreported(manifold, continued, anchors);
  for (int i = 0; mayBeAnchored && i < continued; ++i)
    anchors[static_cast<std::size_t>(i)].restore(manifold, manifold.getContactPoint(i));
  if (gContactProcessedCallback)
    for (int i = 0; i < continued; ++i)
      gContactProcessedCallback(manifold.getContactPoint(i), const_cast<btCollisionObject*>(manifold.getBody0()),
                                const_cast<btCollisionObject*>(manifold.getBody1()));
  if (motion_.isSlow()) putDeepestLast(manifold);
}

void ManifoldWriter::add(btPersistentManifold& manifold, const Contact& contact) {
  btPersistentManifold* const before = result_.getPersistentManifold();
  result_.setPersistentManifold(&manifold);
  const ContactId& id = contact.id;
  // Ids follow the order of the result's bodies, points and normals that of the manifold's. A compound may swap the
  // former.
  const bool treeIsResultBody0 = treeIsBody0_ == (result_.getBody0Internal() == manifold.getBody0());
  if (treeIsResultBody0) {
    result_.setShapeIdentifiersA(id.treePart, id.treeIndex);
    result_.setShapeIdentifiersB(id.otherPart, id.otherIndex);
  } else {
    result_.setShapeIdentifiersA(id.otherPart, id.otherIndex);
    result_.setShapeIdentifiersB(id.treePart, id.treeIndex);
  }
  const Vec3 normal = treeIsBody0_ ? contact.normal : -contact.normal;
  const Vec3 onBody0 = treeIsBody0_ ? contact.onTree() : contact.onCollider();
  const Vec3 onBody1 = treeIsBody0_ ? contact.onCollider() : contact.onTree();
  // Bullet refuses points as far apart as a speculative contact's, and merges two that are not in line with the normal.
  // So it gets the point on body 0 as touching; `placeSpeculative` sets the other point.
  const btVector3 reported = origin_ + toBullet(contact.isSpeculative ? onBody0 : onBody1);
  const btScalar distance = contact.isSpeculative ? btScalar(0) : btScalar(contact.separation);
  for (int i = 0; i < manifold.getNumContacts(); ++i) manifold.getContactPoint(i).m_contactPointFlags |= kExistingPoint;
  result_.addContactPoint(toBullet(normal), reported, distance);
  result_.setPersistentManifold(before);
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    const bool isThis = (point.m_contactPointFlags & kExistingPoint) == 0;
    point.m_contactPointFlags &= ~kExistingPoint;
    if (!isThis) continue;
    if (contact.isGuard) point.m_contactPointFlags |= kGuardFlag;
    if (contact.lock != Lock::none) lock(point, contact.lock);
    if (point.m_positionWorldOnB != reported || point.m_distance1 != distance) refresh(manifold, point);
    if (contact.isSpeculative) placeSpeculative(manifold, point, contact, origin_ + toBullet(onBody1));
    setSolverDistance(point, contact);
  }
}

void ManifoldWriter::placeSpeculative(const btPersistentManifold& manifold, btManifoldPoint& point,
                                      const Contact& contact, const btVector3& onBody1) {
  point.m_positionWorldOnB = onBody1;
  point.m_localPointB = manifold.getBody1()->getWorldTransform().invXform(onBody1);
  point.m_distance1 = btScalar(contact.distance());
}

// The solver uses a point's distance alone, so only the distance is changed, and the positions stay true. Contacts of
// spheres do not bounce, because the surfaces in them may not touch at all.
void ManifoldWriter::setSolverDistance(btManifoldPoint& point, const Contact& contact) const {
  const bool mayBounce = contact.isSpeculative ? !contact.isSecondary : !contact.ofSpheres;
  const btScalar closing = mayBounce ? btScalar(motion_.closingSpeed(contact)) : btScalar(0);
  point.m_distance1 = solverDistance(point.m_distance1 + btScalar(contact.curvatureCorrection), closing,
                                     point.m_combinedRestitution, btScalar(motion_.timeStep));
}

}  // namespace cairn::bullet
