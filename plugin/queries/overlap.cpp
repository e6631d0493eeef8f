// SPDX-License-Identifier: Zlib
#include "cairn/bullet/overlap.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace cairn::bullet {

namespace {

// The deepest contact of one object with all objects it is tested against.
struct Deepest final : btCollisionWorld::ContactResultCallback {
  Deepest(const btCollisionObject& object, btScalar tolerance) : object_(object), tolerance_(tolerance) {}

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int, int,
                           const btCollisionObjectWrapper* b, int, int) override {
    const bool isFirst = a->getCollisionObject() == &object_;
    const btCollisionObject* const other = (isFirst ? b : a)->getCollisionObject();
    const btScalar depth = -point.getDistance();
    if (!other->hasContactResponse() || !(depth > tolerance_)) return 0;
    others.insert(other);
    if (depth <= overlap.depth) return 0;
    overlap.with = other;
    overlap.depth = depth;
    overlap.direction = isFirst ? point.m_normalWorldOnB : -point.m_normalWorldOnB;
    return 0;
  }

  Overlap overlap;
  std::set<const btCollisionObject*> others;

 private:
  const btCollisionObject& object_;
  btScalar tolerance_;
};

// Two objects whose boxes overlap; at least one may move.
struct Pair {
  btCollisionObject *first, *second;
};

bool mayMove(const btCollisionObject& object) {
  return !object.isStaticOrKinematicObject() && object.getInternalType() == btCollisionObject::CO_RIGID_BODY;
}

btScalar sizeOf(const btCollisionObject& object) {
  btVector3 lower, upper;
  object.getCollisionShape()->getAabb(object.getWorldTransform(), lower, upper);
  return (upper - lower).length();
}

std::vector<Pair> pairsOf(btCollisionWorld& world) {
  world.updateAabbs();
  world.computeOverlappingPairs();
  const btBroadphasePairArray& all = world.getPairCache()->getOverlappingPairArray();
  std::vector<Pair> pairs;
  for (int i = 0; i < all.size(); ++i) {
    const Pair pair{static_cast<btCollisionObject*>(all[i].m_pProxy0->m_clientObject),
                    static_cast<btCollisionObject*>(all[i].m_pProxy1->m_clientObject)};
    const bool isSolid = pair.first->hasContactResponse() && pair.second->hasContactResponse();
    if (isSolid && (mayMove(*pair.first) || mayMove(*pair.second))) pairs.push_back(pair);
  }
  // Sorted by their indices in the world, because the order of the broad phase depends on its history.
  const auto places = [](const Pair& pair) {
    const int a = pair.first->getWorldArrayIndex(), b = pair.second->getWorldArrayIndex();
    return std::pair(std::min(a, b), std::max(a, b));
  };
  std::sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) { return places(a) < places(b); });
  return pairs;
}

void move(btCollisionObject& object, const btVector3& by) {
  btTransform pose = object.getWorldTransform();
  pose.getOrigin() += by;
  object.setWorldTransform(pose);
  object.setInterpolationWorldTransform(pose);
  btRigidBody* const body = btRigidBody::upcast(&object);
  if (body && body->getMotionState()) body->getMotionState()->setWorldTransform(pose);
  object.activate();
}

// The displacement of a pair's first object in one pass.
btVector3 wayOut(const Pair& pair, const Overlap& overlap, btScalar size) {
  constexpr btScalar kShallow = btScalar(0.05);  // sizes: up to this depth the contact's normal is trusted
  constexpr btScalar kStride = btScalar(0.05);   // sizes
  constexpr btScalar kSurplus = btScalar(1.01);  // otherwise the rest of a depth would take infinitely many passes
  const bool isPushed = mayMove(*pair.first) && mayMove(*pair.second);
  if (overlap.depth <= kShallow * size || !isPushed) return overlap.direction * (kSurplus * overlap.depth);
  const btVector3 apart = pair.first->getWorldTransform().getOrigin() - pair.second->getWorldTransform().getOrigin();
  const btScalar distance = apart.length();
  return (distance > kStride * size * btScalar(0.01) ? apart / distance : overlap.direction) * (kStride * size);
}

// Moves the objects apart if they overlap; whether they did.
bool separatePair(btCollisionWorld& world, const Pair& pair, btScalar tolerance) {
  const btScalar size = std::min(sizeOf(*pair.first), sizeOf(*pair.second));
  Deepest deepest(*pair.first, tolerance * size);
  world.contactPairTest(pair.first, pair.second, deepest);
  if (deepest.others.empty()) return false;
  const btVector3 displacement = wayOut(pair, deepest.overlap, size);
  const bool both = mayMove(*pair.first) && mayMove(*pair.second);
  const btScalar part = both ? btScalar(0.5) : btScalar(1);
  if (mayMove(*pair.first)) move(*pair.first, displacement * part);
  if (mayMove(*pair.second)) move(*pair.second, displacement * -part);
  return true;
}

}  // namespace

std::optional<Overlap> overlapAt(btCollisionWorld& world, btCollisionShape& shape, const btTransform& pose,
                                 btScalar tolerance, int mask) {
  btCollisionObject object;
  object.setCollisionShape(&shape);
  object.setWorldTransform(pose);
  Deepest deepest(object, tolerance);
  deepest.m_collisionFilterGroup = -1;
  deepest.m_collisionFilterMask = mask;
  world.contactTest(&object, deepest);
  if (deepest.others.empty()) return std::nullopt;
  deepest.overlap.count = static_cast<int>(deepest.others.size());
  return deepest.overlap;
}

Separation separate(btCollisionWorld& world, const SeparationLimits& limits) {
  Separation done;
  std::vector<btVector3> before;
  for (int i = 0; i < world.getNumCollisionObjects(); ++i)
    before.push_back(world.getCollisionObjectArray()[i]->getWorldTransform().getOrigin());
  for (int pass = 0; pass <= limits.passes; ++pass) {
    done.left = 0;
    for (const Pair& pair : pairsOf(world)) done.left += separatePair(world, pair, limits.tolerance) ? 1 : 0;
    if (pass == 0) done.overlaps = done.left;
    done.passes = pass;
    if (done.left == 0) break;
  }
  world.updateAabbs();
  for (int i = 0; i < world.getNumCollisionObjects(); ++i)
    done.moved = std::max(done.moved, world.getCollisionObjectArray()[i]->getWorldTransform().getOrigin().distance(
                                          before[static_cast<std::size_t>(i)]));
  return done;
}

}  // namespace cairn::bullet
