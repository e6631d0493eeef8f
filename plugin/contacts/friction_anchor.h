// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

namespace cairn::bullet {

/// Where friction holds two bodies to each other (`btCollisionObject::CF_HAS_FRICTION_ANCHOR` on either): Bullet's
/// solver pulls the two points of an anchored contact back together along the surface, so they stay those of when they
/// first met for as long as friction can hold them.
///
/// Bullet keeps such a point as it is instead of replacing it, and brings it up to date in `refreshContactPoints`. A
/// `ManifoldWriter` refreshes nothing: it has the point replaced by the contact of this step and gives it back its
/// hold.
class FrictionAnchor {
 public:
  /// Whether Bullet anchors the points of these bodies.
  static bool isAskedFor(const btPersistentManifold& manifold);

  FrictionAnchor() = default;
  /// What the point has now.
  explicit FrictionAnchor(const btManifoldPoint& point);

  /// Has Bullet replace the point when it is told of one in its place; `restore` then has to follow.
  static void release(btManifoldPoint& point);

  /// Gives the point, replaced or not, its impulses back. Where it was anchored and had not begun to slip (Bullet's own
  /// rule: last step's friction within its cone) and is to stay so, it is put back to where it was held along the
  /// surface; how deep it is stays as it is. Where the bodies have slid by more than the manifold's breaking threshold
  /// it stays where it is.
  void restore(const btPersistentManifold& manifold, btManifoldPoint& point) const;

 private:
  void hold(const btPersistentManifold& manifold, btManifoldPoint& point) const;

  bool holds_ = false;
  btVector3 local0_, local1_;  // on the bodies
  btScalar impulse_ = 0, lateralImpulse1_ = 0, lateralImpulse2_ = 0;
};

}  // namespace cairn::bullet
