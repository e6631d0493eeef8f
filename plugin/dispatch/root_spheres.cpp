// SPDX-License-Identifier: Zlib
#include "dispatch/root_spheres.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include <algorithm>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

bool areRootsApart(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
  const SphereTreeShape* const a = asSphereTree(body0.getCollisionShape());
  const SphereTreeShape* const b = a ? asSphereTree(body1.getCollisionShape()) : nullptr;
  if (!b) return false;
  btVector3 centerA, centerB;
  btScalar radiusA = 0, radiusB = 0;
  a->getBoundingSphere(centerA, radiusA);
  b->getBoundingSphere(centerB, radiusB);
  // From one body's origin, where numbers are small.
  const btTransform &poseA = body0.getWorldTransform(), &poseB = body1.getWorldTransform();
  const btVector3 armA = poseA.getBasis() * centerA, armB = poseB.getBasis() * centerB;
  const btVector3 apart = (poseB.getOrigin() - poseA.getOrigin()) + armB - armA;
  const btScalar reach = radiusA + radiusB + kSpeculativeFraction * std::min(a->size(), b->size());
  const btScalar lengths = armA.length() + armB.length() + reach;
  const btScalar touching = reach + btScalar(kOverlapSlack) * lengths;
  return apart.length2() > touching * touching * (1 + btScalar(kOverlapSlack));
}

}  // namespace cairn::bullet
