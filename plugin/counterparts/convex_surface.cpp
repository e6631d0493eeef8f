// SPDX-License-Identifier: Zlib
#include "counterparts/convex_surface.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>

#include <algorithm>
#include <cmath>

#include "placement/bullet_math.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

namespace {

struct GjkAnswer final : btDiscreteCollisionDetectorInterface::Result {
  NearestPoint nearest;
  bool found = false;

  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3& normalOnB, const btVector3& pointOnB, btScalar depth) override {
    nearest = {toVec3(pointOnB), toVec3(normalOnB), static_cast<float>(depth)};
    found = true;
  }
};

}  // namespace

NearestPoint nearestOnBox(const Vec3& halfExtents, const Vec3& p) {
  Vec3 clamped;
  for (int axis = 0; axis < 3; ++axis) clamped[axis] = std::clamp(p[axis], -halfExtents[axis], halfExtents[axis]);
  const Vec3 out = p - clamped;
  if (out != Vec3()) return {clamped, unitVector(out), length(out)};
  int face = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (halfExtents[axis] - std::abs(p[axis]) < halfExtents[face] - std::abs(p[face])) face = axis;
  NearestPoint nearest{p, {}, std::abs(p[face]) - halfExtents[face]};
  nearest.normal[face] = std::copysign(1.0F, p[face]);
  nearest.point[face] = std::copysign(halfExtents[face], p[face]);
  return nearest;
}

NearestPoint nearestOnSphere(float radius, const Vec3& p) {
  const float fromCenter = length(p);
  const Vec3 normal = p != Vec3() ? unitVector(p) : Vec3(0, 0, 1);
  return {normal * radius, normal, fromCenter - radius};
}

NearestPoint ConvexSurface::nearest(const Vec3& p) {
  switch (shape_->getShapeType()) {
    case BOX_SHAPE_PROXYTYPE:
      return nearestOnBox(toVec3(static_cast<const btBoxShape*>(shape_)->getHalfExtentsWithMargin()), p);
    case SPHERE_SHAPE_PROXYTYPE:
      return nearestOnSphere(static_cast<float>(shape_->getMargin()), p);
    default:
      return nearestByGjk(p);
  }
}

bool ConvexSurface::isClosedForm() const {
  return shape_->getShapeType() == BOX_SHAPE_PROXYTYPE || shape_->getShapeType() == SPHERE_SHAPE_PROXYTYPE;
}

Vec3 ConvexSurface::support(const Vec3& direction) const {
  return toVec3(shape_->localGetSupportingVertex(toBullet(direction)));
}

NearestPoint ConvexSurface::nearestByGjk(const Vec3& p) {
  const std::optional<NearestPoint> found = askGjk(point_, p);
  return found ? *found : supportingPlane(p);
}

std::optional<NearestPoint> ConvexSurface::nearestToHull(std::span<const Vec3> points) {
  std::array<btVector3, kMaxHullPoints> hullPoints;
  const std::size_t count = std::min(points.size(), hullPoints.size());
  for (std::size_t i = 0; i < count; ++i) hullPoints[i] = toBullet(points[i]);
  hull_.setPoints(hullPoints.data(), static_cast<int>(count), false);
  return askGjk(hull_, {});
}

std::optional<NearestPoint> ConvexSurface::askGjk(const btConvexShape& other, const Vec3& origin) {
  btGjkPairDetector gjk(&other, shape_, &simplex_, &penetration_);
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
  input.m_transformA.setIdentity();
  input.m_transformA.setOrigin(toBullet(origin));
  input.m_transformB.setIdentity();
  GjkAnswer answer;
  gjk.getClosestPoints(input, answer, nullptr);
  if (!answer.found) return std::nullopt;
  return answer.nearest;
}

// GJK and EPA can give up on a point that lies on the surface. The plane that supports the shape in the point's
// direction from the middle of its box is then a true, if not the least, separation.
NearestPoint ConvexSurface::supportingPlane(const Vec3& p) const {
  btVector3 lower, upper;
  shape_->getAabb(btTransform::getIdentity(), lower, upper);
  const Vec3 out = p - toVec3((lower + upper) * btScalar(0.5));
  const Vec3 normal = out != Vec3() ? unitVector(out) : Vec3(0, 0, 1);
  const float distance = dot(normal, p - support(normal));
  return {p - normal * distance, normal, distance};
}

}  // namespace cairn::bullet
