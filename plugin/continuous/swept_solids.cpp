// SPDX-License-Identifier: Zlib
#include "continuous/swept_solids.h"

#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/bullet_math.h"

namespace cairn::bullet {

std::optional<float> entryIntoBox(const Vec3& lower, const Vec3& upper, const Vec3& point, const Vec3& way) {
  float from = 0, to = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) {
      if (point[axis] < lower[axis] || point[axis] > upper[axis]) return std::nullopt;
      continue;
    }
    const float one = (lower[axis] - point[axis]) / way[axis], other = (upper[axis] - point[axis]) / way[axis];
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  if (from > to) return std::nullopt;
  return from;
}

void SweptPlane::take(const btCollisionShape& shape, const btVector3& /*lower*/, const btVector3& /*upper*/) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
  normal_ = toVec3(plane.getPlaneNormal());
  offset_ = static_cast<float>(plane.getPlaneConstant());
}

float SweptPlane::radius(std::uint32_t /*element*/) const {
  return std::numeric_limits<float>::infinity();
}

std::optional<float> SweptPlane::entry(const Sphere& ball, std::uint32_t /*element*/, const Vec3& way) const {
  const float height = dot(normal_, ball.center) - offset_ - ball.radius;
  if (height <= 0) return 0.0F;
  const float closing = -dot(normal_, way);
  if (closing < height) return std::nullopt;
  return height / closing;
}

// Nothing lies farther along any other direction that is asked for, as only the normal is offered.
Vec3 SweptPlane::support(std::uint32_t /*element*/, const Vec3& direction) const {
  const float cosine = dot(normal_, direction);
  return cosine > 0.999F ? normal_ * offset_ : direction * std::numeric_limits<float>::infinity();
}

void SweptPlane::appendNormals(std::uint32_t /*element*/, const Vec3& /*center*/, SeparatingNormals& normals) {
  normals.add(normal_, true);
}

void SweptConvex::take(const btCollisionShape& shape, const btVector3& /*lower*/, const btVector3& /*upper*/) {
  surface_.setShape(static_cast<const btConvexShape&>(shape));
  btVector3 lower, upper;
  shape.getAabb(btTransform::getIdentity(), lower, upper);
  lower_ = toVec3(lower);
  upper_ = toVec3(upper);
}

float SweptConvex::radius(std::uint32_t /*element*/) const {
  return 0.5F * length(upper_ - lower_);
}

std::optional<float> SweptConvex::entry(const Sphere& ball, std::uint32_t /*element*/, const Vec3& way) const {
  const Vec3 grow(ball.radius, ball.radius, ball.radius);
  return entryIntoBox(lower_ - grow, upper_ + grow, ball.center, way);
}

void SweptConvex::appendNormals(std::uint32_t /*element*/, const Vec3& center, SeparatingNormals& normals) {
  normals.add(surface_.nearest(center).normal, false);
}

}  // namespace cairn::bullet
