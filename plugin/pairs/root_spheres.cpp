// SPDX-License-Identifier: Zlib
#include "pairs/root_spheres.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include <algorithm>
#include <cmath>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/bullet/terrain_shape.h"
#include "pairs/coarse_ground.h"
#include "placement/bullet_math.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

std::optional<RootSpheres> rootSpheres(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
  const SphereTreeShape* const a = asSphereTree(body0.getCollisionShape());
  const SphereTreeShape* const b = a ? asSphereTree(body1.getCollisionShape()) : nullptr;
  if (!b) return std::nullopt;
  RootSpheres roots;
  a->getBoundingSphere(roots.centerA, roots.radiusA);
  b->getBoundingSphere(roots.centerB, roots.radiusB);
  // Relative to one body's origin, where coordinates are small.
  const btTransform &poseA = body0.getWorldTransform(), &poseB = body1.getWorldTransform();
  roots.centerA = poseA.getBasis() * roots.centerA;
  const btVector3 armB = poseB.getBasis() * roots.centerB;
  roots.lengths = roots.centerA.length() + armB.length();
  roots.centerB = (poseB.getOrigin() - poseA.getOrigin()) + armB;
  return roots;
}

bool RootSpheres::areSeparated(btScalar maxSeparation) const {
  const btScalar wanted = radiusA + radiusB + maxSeparation;
  const btScalar touching = wanted + btScalar(kOverlapSlack) * (lengths + wanted);
  return (centerB - centerA).length2() > touching * touching * (1 + btScalar(kOverlapSlack));
}

namespace {

bool isClearOf(const btCollisionObjectWrapper& planeBody, const btCollisionObjectWrapper& treeBody, btScalar travel) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(*planeBody.getCollisionShape());
  const SphereTreeShape& tree = *asSphereTree(treeBody.getCollisionShape());
  const btTransform &planePose = planeBody.getWorldTransform(), &treePose = treeBody.getWorldTransform();
  btVector3 center;
  btScalar radius = 0;
  tree.getBoundingSphere(center, radius);
  const btVector3 way = treePose.getOrigin() - planePose.getOrigin(), arm = treePose.getBasis() * center;
  const btScalar height = (planePose.getBasis() * plane.getPlaneNormal()).dot(way + arm) - plane.getPlaneConstant();
  const btScalar wanted = radius + btScalar(kSpeculativeFraction) * tree.size() + travel;
  const btScalar lengths = way.length() + arm.length() + std::abs(plane.getPlaneConstant()) + wanted;
  return height > wanted + btScalar(kOverlapSlack) * lengths;
}

bool isPlane(const btCollisionObjectWrapper& body) {
  return body.getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE;
}

}  // namespace

bool areRootsSeparated(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                       const std::optional<RootSpheres>& roots, btScalar travel) {
  if (roots) {
    const SphereTreeShape &a = *asSphereTree(body0.getCollisionShape()), &b = *asSphereTree(body1.getCollisionShape());
    return roots->areSeparated(btScalar(kSpeculativeFraction) * std::min(a.size(), b.size()) + travel);
  }
  if (asTerrain(body0.getCollisionShape()))
    return asSphereTree(body1.getCollisionShape()) && isClearOfGround(body1, body0, travel);
  if (asTerrain(body1.getCollisionShape()))
    return asSphereTree(body0.getCollisionShape()) && isClearOfGround(body0, body1, travel);
  if (isPlane(body0)) return asSphereTree(body1.getCollisionShape()) && isClearOf(body0, body1, travel);
  return isPlane(body1) && asSphereTree(body0.getCollisionShape()) && isClearOf(body1, body0, travel);
}

namespace {

// The square of a shorter length has few digits left.
constexpr btScalar kMinLength = btScalar(1e-18);

}  // namespace

bool RootSpheres::areAlike() const {
  return std::max(radiusA, radiusB) <= btScalar(kMaxSizeRatio) * std::min(radiusA, radiusB);
}

Contact RootSpheres::contact() const {
  const btVector3 line = centerA - centerB;
  const btScalar length = line.length();
  Contact contact;
  contact.ofSpheres = contact.isRootContact = true;
  contact.pair = {kRootNode, kRootNode};
  contact.normal = length > kMinLength ? toVec3(line / length) : unitVector(toVec3(line));
  if (contact.normal == Vec3()) contact.normal = Vec3(0, 0, 1);
  contact.separation = static_cast<float>(length - radiusA - radiusB);
  contact.position = toVec3(centerB) + contact.normal * (static_cast<float>(radiusB) + 0.5F * contact.separation);
  contact.id = {0, static_cast<int>(kRootNode), 0, static_cast<int>(kRootNode)};
  return contact;
}

}  // namespace cairn::bullet
