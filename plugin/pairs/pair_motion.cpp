// SPDX-License-Identifier: Zlib
#include "pairs/pair_motion.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>

#include "pairs/body_motion.h"
#include "placement/bullet_math.h"
#include "placement/tree_pose.h"

namespace cairn::bullet {

namespace {

// How much farther than its speed explains a body may move in a step by itself, as a fraction of the smaller body's
// size.
constexpr float kOwnMotionFraction = 0.25F;

// Centre of the smaller body: of its root sphere, or the origin of a shape that is no tree.
Vec3d smallerCenter(const PairPlacement& placement, bool treeIsSmaller) {
  const SphereTreeShape* const shape = treeIsSmaller ? placement.treeShape : asSphereTree(placement.otherShape);
  const btTransform& body = treeIsSmaller ? placement.treeBody : placement.other;
  return shape ? treePose(*shape, body) * Vec3d(shape->tree().sphere(kRootNode).center) : toVec3d(body.getOrigin());
}

}  // namespace

PairSizes PairSizes::of(const SphereTreeShape& tree, float otherSize, btScalar threshold, float ahead) {
  const auto treeSize = static_cast<float>(tree.size());
  PairSizes sizes;
  sizes.smaller = otherSize > 0 ? std::min(treeSize, otherSize) : treeSize;
  sizes.speculative = static_cast<float>(kSpeculativeFraction) * sizes.smaller;
  sizes.reported = sizes.speculative + static_cast<float>(threshold);
  sizes.maxSeparation = std::max(sizes.reported, sizes.speculative + ahead);
  sizes.treeIsSmaller = !(otherSize > 0 && otherSize < treeSize);
  return sizes;
}

RelativePlacement PairMotion::placementOf(const PairSides& sides) {
  const btTransform &tree = sides.tree.getWorldTransform(), &other = sides.other.getWorldTransform();
  RelativePlacement placement;
  placement.treeInOther.setBasis(other.getBasis().transposeTimes(tree.getBasis()));
  placement.treeInOther.setOrigin((tree.getOrigin() - other.getOrigin()) * other.getBasis());
  sides.shape()->getBoundingSphere(placement.center, placement.radius);
  return placement;
}

float PairMotion::speedInOther(const PairSides& sides) {
  return speedInFrameOf(*sides.other.getCollisionObject(), *sides.tree.getCollisionObject(),
                        static_cast<float>(sides.shape()->getAngularMotionDisc()));
}

PairPlacement PairMotion::place(const PairSides& sides, const PairSizes& sizes) {
  const SphereTreeShape* const shape = sides.shape();
  origin = sides.tree.getWorldTransform().getOrigin();
  PairPlacement placement;
  placement.treeShape = shape;
  placement.treeBody = btTransform(sides.tree.getWorldTransform().getBasis());
  placement.tree = placedTree(*shape, placement.treeBody, sizes.smaller);
  placement.smallerSize = sizes.smaller;
  placement.treeMargin = static_cast<float>(shape->getMargin());
  placement.otherShape = &sides.otherShape();
  placement.other = sides.other.getWorldTransform();
  placement.other.getOrigin() -= origin;
  placement.otherIndex = sides.other.m_index;
  placement.maxSeparation = sizes.maxSeparation;
  placement.speculativeDistance = sizes.speculative;
  center = toVec3d(origin) + smallerCenter(placement, sizes.treeIsSmaller);
  return placement;
}

void PairMotion::follow(const PairSides& sides, const PairSizes& sizes) {
  origin = sides.tree.getWorldTransform().getOrigin();
  center = toVec3d((sizes.treeIsSmaller ? sides.tree : sides.other).getWorldTransform().getOrigin());
}

bool PairMotion::areSetDown(const RelativePlacement& now, const PairSides& sides, const PairSizes& sizes,
                            btScalar timeStep) const {
  const float ownMotion = kOwnMotionFraction * sizes.smaller;
  const auto moved = static_cast<float>(now.displacementSince(seenAt));
  return moved > ownMotion && moved > speedInOther(sides) * static_cast<float>(timeStep) + ownMotion;
}

void PairMotion::set(const PairSides& sides, const PairSizes& sizes, btScalar timeStep) {
  setVelocities(sides, timeStep);
  const btCollisionObject& tree = *sides.tree.getCollisionObject();
  const btCollisionObject& other = *sides.other.getCollisionObject();
  const auto disc = static_cast<float>(sides.shape()->getAngularMotionDisc());
  closingSpeed = cairn::bullet::closingSpeed(tree, other, disc);
  reducedMass = cairn::bullet::reducedMass(tree, other);
  relative.smallerSize = sizes.smaller;
  relative.maxSeparation = sizes.maxSeparation;
  relative.reported = sizes.reported;
  relative.placement = placementOf(sides);
}

void PairMotion::setVelocities(const PairSides& sides, btScalar timeStep) {
  const btCollisionObject& tree = *sides.tree.getCollisionObject();
  const btCollisionObject& other = *sides.other.getCollisionObject();
  relative.treeLinear = linearVelocity(tree);
  relative.treeAngular = angularVelocity(tree);
  relative.treeCenter = toVec3(tree.getWorldTransform().getOrigin() - origin);
  relative.otherLinear = linearVelocity(other);
  relative.otherAngular = angularVelocity(other);
  relative.otherCenter = toVec3(other.getWorldTransform().getOrigin() - origin);
  relative.timeStep = static_cast<float>(timeStep);
}

}  // namespace cairn::bullet
