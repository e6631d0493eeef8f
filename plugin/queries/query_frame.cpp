// SPDX-License-Identifier: Zlib
#include "queries/query_frame.h"

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Bullet's cast ends when the shapes are this close, in the world's unit.
constexpr double kContactRadius = 0.001;
// Bullet reads the rotation between two equal rotations from a quaternion's real part, which is 1 within some units of
// rounding. As an angle, the error is the square root of that.
const double kTurnNoise = 8 * std::sqrt(double(SIMD_EPSILON));

}  // namespace

Mover moverOf(const btTriangleConvexcastCallback& callback, const btTransform& worldFromFrame) {
  const btConvexShape& convex = *callback.m_convexShape;
  const btScalar disc = convex.getAngularMotionDisc();
  Mover mover{btVector3(0, 0, 0), btVector3(disc, disc, disc)};
  if (callback.m_convexShapeFrom.getBasis() == callback.m_convexShapeTo.getBasis()) {
    btVector3 lower, upper;
    convex.getAabb(btTransform(worldFromFrame.getBasis().transposeTimes(callback.m_convexShapeFrom.getBasis())), lower,
                   upper);
    const btScalar noise = btScalar(kTurnNoise) * disc;
    mover = {(lower + upper) / 2, (upper - lower) / 2 + btVector3(noise, noise, noise)};
  }
  const btScalar grow = btScalar(kContactRadius) + callback.m_triangleCollisionMargin +
                        std::max(btScalar(0), -callback.m_allowedPenetration);
  mover.halfExtent += btVector3(grow, grow, grow);
  return mover;
}

Vec3d pointInTree(const SphereTreeShape& shape, const btVector3& point) {
  return toVec3d(shape.bodyFromTree().invXform(point)) / double(shape.scale());
}

double edgeTolerance(const SphereTreeShape& shape) {
  return 2e-4 * double(shape.size()) / double(shape.scale());
}

double roundingSlack(const SphereTreeShape& shape, double farthest) {
  const auto reach = double(shape.tree().extent());
  return kQueryRoundings * ((farthest / double(shape.scale()) + reach) * double(SIMD_EPSILON) +
                            reach * double(std::numeric_limits<float>::epsilon()));
}

Segment segmentOf(const SphereTreeShape& shape, const btTriangleRaycastCallback& ray, double slack) {
  const double farthest = double(std::max(ray.m_from.length(), ray.m_to.length()));
  return {pointInTree(shape, ray.m_from), pointInTree(shape, ray.m_to), slack + roundingSlack(shape, farthest)};
}

SweptBox sweptBox(const SphereTreeShape& shape, const btTriangleConvexcastCallback& callback, btScalar margin) {
  const btTransform worldFromTree = callback.m_triangleToWorld * shape.bodyFromTree();
  const double scale = double(shape.scale());
  Mover mover = moverOf(callback, worldFromTree);
  mover.halfExtent += btVector3(margin, margin, margin);
  const btVector3 from = worldFromTree.invXform(callback.m_convexShapeFrom.getOrigin()) + mover.center;
  const btVector3 to = worldFromTree.invXform(callback.m_convexShapeTo.getOrigin()) + mover.center;
  const double farthest = double(
      std::max({from.length(), to.length(), callback.m_convexShapeFrom.getOrigin().length(),
                callback.m_convexShapeTo.getOrigin().length(), callback.m_triangleToWorld.getOrigin().length()}));
  const Segment path(toVec3d(from) / scale, toVec3d(to) / scale, roundingSlack(shape, farthest));
  return {path, Vec3(toVec3d(mover.halfExtent) / scale)};
}

}  // namespace cairn::bullet
