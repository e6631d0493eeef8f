// SPDX-License-Identifier: Zlib
#include "pairs/pair_lock.h"

#include <LinearMath/btTransform.h>

namespace cairn::bullet {

namespace {

// Hulls that overlap by more than this fraction of the smaller body's size may hang in each other. Linked rings overlap
// by about half of it; at 0.15 and 0.2 as few of them part. Without a limit, bodies stick to slopes of trees
// (`LockedPairs.AreNotThoseThatSlide`).
constexpr btScalar kHanging = btScalar(0.25);

// The least way along one of a frame's axes by which one body leaves the other's hull.
btScalar wayOut(const PairSides& sides, const btMatrix3x3& frameFromWorld) {
  const btTransform turn(frameFromWorld);
  btVector3 lowerA, upperA, lowerB, upperB;
  sides.tree.getCollisionShape()->getAabb(turn * sides.tree.getWorldTransform(), lowerA, upperA);
  sides.otherShape().getAabb(turn * sides.other.getWorldTransform(), lowerB, upperB);
  btVector3 way = upperA - lowerB;
  way.setMin(upperB - lowerA);
  return way[way.minAxis()];
}

btMatrix3x3 frameAlong(const btVector3& normal) {
  btVector3 across, third;
  btPlaneSpace1(normal, across, third);
  return {normal.x(), normal.y(), normal.z(), across.x(), across.y(), across.z(), third.x(), third.y(), third.z()};
}

bool hasHollows(const SphereTreeShape& tree) {
  return tree.tree().surface().features.hasHollows();
}

bool mayHang(const TreePair& pair, const PairSides& sides, const btVector3& normal) {
  if (!hasHollows(*sides.shape()) && !hasHollows(*sides.otherTree())) return false;
  const btScalar hanging = kHanging * btScalar(pair.sizes.smaller);
  return wayOut(sides, btMatrix3x3::getIdentity()) > hanging && wayOut(sides, frameAlong(normal)) > hanging;
}

bool mustLock(const TreePair& pair, const PairSides& sides, bool isLocked) {
  if (!pair.motion.roots || !pair.motion.roots->areAlike()) return false;
  const btManifoldPoint* const loaded = pair.manifolds.mostLoaded();
  const bool carries = loaded && (isLocked || loaded->m_appliedImpulse > 0);
  return carries && mayHang(pair, sides, loaded->m_normalWorldOnB);
}

}  // namespace

void lockOrRelease(TreePair& pair, const PairSides& sides, bool needsAnswer) {
  PairGuards& guards = pair.contacts.guards();
  const bool wasLocked = guards.areLocked();
  guards.lock(needsAnswer && mustLock(pair, sides, wasLocked));
  if (wasLocked && !guards.areLocked()) pair.manifolds.unlock();
}

}  // namespace cairn::bullet
