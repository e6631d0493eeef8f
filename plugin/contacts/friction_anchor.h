// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

namespace cairn::bullet {

/// Friction that holds two bodies to each other at fixed points (`btCollisionObject::CF_HAS_FRICTION_ANCHOR` on
/// either). Bullet's solver pulls the two points of an anchored contact together along the surface. So the contact
/// keeps its first points for as long as friction can hold them.
///
/// Bullet does not replace such a point; it updates the point in `refreshContactPoints`. A `ManifoldWriter` refreshes
/// nothing. It has the point replaced by this step's contact, and then restores the anchor:
///
///     const FrictionAnchor anchor(point);
///     FrictionAnchor::release(point);  // now addContactPoint replaces it
///     anchor.restore(manifold, point);
class FrictionAnchor {
 public:
  /// Whether Bullet anchors the points of these bodies.
  static bool isAskedFor(const btPersistentManifold& manifold);

  FrictionAnchor() = default;
  /// Copies the point's present anchor and impulses.
  explicit FrictionAnchor(const btManifoldPoint& point);

  /// Makes Bullet replace the point when a contact is added in its place. `restore` must follow.
  static void release(btManifoldPoint& point);

  /// Gives the point its impulses back, whether it was replaced or not. If the point was and still is anchored and had
  /// not begun to slip, it moves back to its held place along the surface. Slip follows Bullet's rule: last step's
  /// friction outside its cone. The depth stays as it is. If the bodies have slid by more than the manifold's breaking
  /// threshold, the point stays where it is.
  void restore(const btPersistentManifold& manifold, btManifoldPoint& point) const;

 private:
  void hold(const btPersistentManifold& manifold, btManifoldPoint& point) const;

  bool holds_ = false;
  btVector3 local0_, local1_;  // points on bodies 0 and 1, in their frames
  btScalar impulse_ = 0, lateralImpulse1_ = 0, lateralImpulse2_ = 0;
};

}  // namespace cairn::bullet
