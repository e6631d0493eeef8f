// SPDX-License-Identifier: Zlib
#include "continuous/swept_plane.h"

#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

#include <limits>

#include "placement/bullet_math.h"

namespace cairn::bullet {

void SweptPlane::take(const btCollisionShape& shape, const btVector3& /*lower*/, const btVector3& /*upper*/) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
  normal_ = toVec3(plane.getPlaneNormal());
  offset_ = static_cast<float>(plane.getPlaneConstant());
}

float SweptPlane::radius(std::uint32_t /*element*/) const {
  return std::numeric_limits<float>::infinity();
}

std::optional<float> SweptPlane::entry(const Sphere& ball, std::uint32_t /*element*/, const Vec3& displacement) const {
  const float height = dot(normal_, ball.center) - offset_ - ball.radius;
  if (height <= 0) return 0.0F;
  const float closing = -dot(normal_, displacement);
  if (closing < height) return std::nullopt;
  return height / closing;
}

// Along any other direction the half-space is infinite, so nothing is apart from it.
Vec3 SweptPlane::support(std::uint32_t /*element*/, const Vec3& direction) const {
  const float cosine = dot(normal_, direction);
  return cosine > 0.999F ? normal_ * offset_ : direction * kInfiniteExtent;
}

void SweptPlane::appendNormals(std::uint32_t /*element*/, const Vec3& /*center*/, SeparatingNormals& normals) {
  normals.add(normal_, true);
}

}  // namespace cairn::bullet
