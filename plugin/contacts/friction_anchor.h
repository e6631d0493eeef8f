// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <optional>

namespace cairn::bullet {

/// Where friction holds two bodies to each other (`btCollisionObject::CF_HAS_FRICTION_ANCHOR` on both): Bullet's solver
/// pulls the two points of an anchored contact back together along the surface, so they stay those of when they first
/// met for as long as friction can hold them.
///
/// Bullet keeps such a point as it is instead of replacing it, and brings it up to date in `refreshContactPoints`. A
/// `ManifoldWriter` refreshes nothing: it has the point replaced by the contact of this step and gives it back its
/// hold.
class FrictionAnchor {
 public:
  /// Of a point that is anchored and has not begun to slip (by Bullet's own rule: last step's friction within its
  /// cone); else nothing.
  static std::optional<FrictionAnchor> of(const btManifoldPoint& point);

  /// Has Bullet replace the point, whatever it is anchored by.
  static void release(btManifoldPoint& point);

  /// Puts `point`, which replaced the anchored one, back to where this holds it along the surface; how deep it is stays
  /// as it is. Where the bodies have slid by more than the manifold's breaking threshold, or no longer ask for it, the
  /// point stays where it is.
  void hold(const btPersistentManifold& manifold, btManifoldPoint& point) const;

 private:
  btVector3 local0_, local1_;  // on the bodies
  btScalar lateralImpulse1_ = 0, lateralImpulse2_ = 0;
};

}  // namespace cairn::bullet
