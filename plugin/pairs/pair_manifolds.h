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

/// The manifolds of a pair in Bullet's hands, and how their points follow the bodies where nothing new is said. One of
/// them may hold what stands in for an answer.
class PairManifolds {
 public:
  /// In the manifolds' order. Precondition: any manifold is of these.
  void setBodies(const btCollisionObject* body0, const btCollisionObject* body1) { bodies_ = {body0, body1}; }
  /// Null only when Bullet's pool is used up and the user forbade it to grow. Points farther apart than `farthest` are
  /// not taken.
  btPersistentManifold* make(int cluster, btDispatcher& dispatcher, btScalar farthest);
  /// Null where none was made.
  btPersistentManifold* at(int cluster) const { return manifolds_[static_cast<std::size_t>(cluster)]; }
  void append(btManifoldArray& manifolds) const;
  void release(btDispatcher& dispatcher);
  /// They stay, empty: Bullet's islands and the user's callbacks see a contact that ended.
  void clear();
  /// Users may have taken some away.
  std::uint32_t countPoints() const;
  std::uint32_t countFilled() const;
  /// Whether a body `isNonFinite` that has points.
  bool areOfNonFinite() const;

  /// Normals stand where body 1 has its axes now.
  void noteAxes() { axes_ = bodies_[1]->getWorldTransform().getBasis(); }
  /// All points follow the bodies. Those farther apart than `farthest` are dropped; none of the stand-in's if it is
  /// `keepsFallback`.
  void follow(std::optional<btScalar> farthest, bool keepsFallback);
  /// Bullet refreshes the points of a compound's children before it asks for new ones, and drops what slid or parted by
  /// more than the manifold's threshold: nothing would be left to hold.
  void surviveRefresh(btScalar farthest);
  /// What Bullet asks of the bodies whenever it is told a point.
  void renewMaterials();
  void forgetImpulses();

  /// The one for what stands in: of those that have fewest points, or most, if there is none yet.
  void chooseFallback(bool amongFullest);
  void endFallback() { fallback_ = kNone; }
  bool hasFallback() const { return fallback_ != kNone; }
  /// Precondition: it has.
  int fallback() const { return fallback_; }
  bool reportsFallback() const { return hasFallback() && at(fallback_) && at(fallback_)->getNumContacts() > 0; }
  /// Not what the stand-in is about to continue: for the user the bodies stay in contact.
  void clearOthers();

  /// Whether guards bear load, by what the solver made of them in the last step; new ones may.
  bool areGuardsLoaded() const;
  /// What creeps down behind guards is slow enough for Bullet to put it to sleep where it floats. Sensors hold nobody;
  /// what the user sends to sleep goes.
  void stayAwake() const;

  /// See `prefetch`: how many points there are, then these.
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
