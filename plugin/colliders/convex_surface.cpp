// SPDX-License-Identifier: Zlib
#include "colliders/convex_surface.h"

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

// Hulls list all their corners; boxes have closed forms.
bool isHull(const btConvexShape& shape) {
  return shape.isPolyhedral() && shape.getShapeType() != BOX_SHAPE_PROXYTYPE;
}

}  // namespace

void ConvexSurface::setShape(const btConvexShape& shape) {
  const bool isSame = hull_ && isStillOf(shape);
  shape_ = &shape;
  if (!isSame) hull_ = isHull(shape) ? HullFaces::of(static_cast<const btPolyhedralConvexShape&>(shape)) : nullptr;
}

bool ConvexSurface::isStillOf(const btConvexShape& shape) const {
  if (shape_ != &shape) return false;
  return !hull_ || (isHull(shape) && hull_->isOf(static_cast<const btPolyhedralConvexShape&>(shape)));
}

NearestPoint ConvexSurface::nearest(const Vec3& p) {
  switch (shape_->getShapeType()) {
    case BOX_SHAPE_PROXYTYPE:
      return nearestOnBox(toVec3(static_cast<const btBoxShape*>(shape_)->getHalfExtentsWithMargin()), p);
    case SPHERE_SHAPE_PROXYTYPE:
      return nearestOnSphere(static_cast<float>(shape_->getMargin()), p);
    default:
      break;
  }
  if (const std::optional<NearestPoint> round = nearestOnRound(*shape_, p)) return *round;
  if (!hull_) return nearestByGjk(p);
  NearestPoint nearest = hull_->nearest(p);
  const auto margin = static_cast<float>(shape_->getMargin());
  nearest.distance -= margin;
  nearest.point += nearest.normal * margin;
  return nearest;
}

float ConvexSurface::apartFrom(const Vec3& p) {
  return hull_ ? hull_->heightAbove(p) - static_cast<float>(shape_->getMargin()) : nearest(p).distance;
}

float ConvexSurface::margin() const {
  return shape_->getShapeType() == BOX_SHAPE_PROXYTYPE ? 0 : static_cast<float>(shape_->getMargin());
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
  points_.setPoints(hullPoints.data(), static_cast<int>(count), false);
  return askGjk(points_, {});
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
// direction from the middle of its box then gives a true, if not the smallest, separation.
NearestPoint ConvexSurface::supportingPlane(const Vec3& p) const {
  btVector3 lower, upper;
  shape_->getAabb(btTransform::getIdentity(), lower, upper);
  const Vec3 out = p - toVec3((lower + upper) * btScalar(0.5));
  const Vec3 normal = out != Vec3() ? unitVector(out) : Vec3(0, 0, 1);
  const float distance = dot(normal, p - support(normal));
  return {p - normal * distance, normal, distance};
}

}  // namespace cairn::bullet
