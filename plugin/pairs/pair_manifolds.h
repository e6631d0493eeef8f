// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <LinearMath/btMatrix3x3.h>

#include <array>
#include <cstdint>
#include <optional>

#include "contacts/normal_clusters.h"

class btDispatcher;

namespace cairn::bullet {

/// The manifolds that Bullet holds of a pair. Their points follow the bodies in steps without new contacts. One
/// manifold may hold the fallback.
class PairManifolds {
 public:
  /// Sets the bodies, in the manifolds' order. Precondition: existing manifolds are of these bodies.
  void setBodies(const btCollisionObject* body0, const btCollisionObject* body1) { bodies_ = {body0, body1}; }
  /// The manifold of a cluster, made if need be. It is null only when Bullet's pool is used up and may not grow. Points
  /// farther apart than `farthest` are not accepted.
  btPersistentManifold* make(int cluster, btDispatcher& dispatcher, btScalar farthest);
  /// The manifold of a cluster, or null.
  btPersistentManifold* at(int cluster) const { return manifolds_[static_cast<std::size_t>(cluster)]; }
  void append(btManifoldArray& manifolds) const;
  void release(btDispatcher& dispatcher);
  /// Removes all points but keeps the manifolds: Bullet's islands and the user's callbacks see a contact that ended.
  void clear();
  /// Counts what Bullet holds; users may have removed points.
  std::uint32_t countPoints() const;
  std::uint32_t countFilled() const;
  /// Whether there are points of a body that `isNonFinite`.
  bool areOfNonFinite() const;

  /// Notes body 1's axes, with which the normals turn.
  void noteAxes() { axes_ = bodies_[1]->getWorldTransform().getBasis(); }
  /// Moves all points with the bodies. Points farther apart than `farthest` are dropped, except the fallback's if
  /// `keepsFallback`.
  void follow(std::optional<btScalar> farthest, bool keepsFallback);
  /// Bullet refreshes the points of a compound's children before it asks for new ones, and drops points beyond the
  /// manifold's threshold. This raises the threshold, so that points are left to carry over.
  void surviveRefresh(btScalar farthest);
  /// Asks the bodies for friction and restitution, as Bullet does for each new point.
  void renewMaterials();
  void forgetImpulses();
  /// Lets points of a lock that ended only forbid approach: as guards of a pair that was never locked.
  void unlock();

  /// Chooses the manifold for the fallback, if there is none yet: the one with fewest points, or with most if
  /// `amongFullest`.
  void chooseFallback(bool amongFullest);
  void endFallback() { fallback_ = kNone; }
  bool hasFallback() const { return fallback_ != kNone; }
  /// The fallback's manifold. Precondition: there is one.
  int fallback() const { return fallback_; }
  bool reportsFallback() const { return hasFallback() && at(fallback_) && at(fallback_)->getNumContacts() > 0; }
  /// Removes all points but the fallback's, so that the bodies stay in contact for the user.
  void clearOthers();

  /// Whether guards carried load in the last solver step. New guards count as if they might.
  bool areGuardsLoaded() const;
  /// The point that carried most load in the last solver step; null where there are no points.
  const btManifoldPoint* mostLoaded() const;
  /// Keeps the bodies awake. A body that sinks slowly onto its guards would fall asleep in the air. Sensors keep nobody
  /// awake, and bodies that the user sends to sleep go.
  void stayAwake() const;

  /// Prefetches the numbers of points, then the points.
  void prefetchCounts() const;
  void prefetchPoints() const;

 private:
  static constexpr int kNone = -1;

  std::array<btPersistentManifold*, kMaxClusters> manifolds_{};
  std::array<const btCollisionObject*, 2> bodies_{};
  btMatrix3x3 axes_ = btMatrix3x3::getIdentity();  // of body 1, where the normals stand
  int fallback_ = kNone;
};

}  // namespace cairn::bullet
