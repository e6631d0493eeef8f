// SPDX-License-Identifier: Zlib
#include "continuous/swept_convex.h"

#include "continuous/entry_into_box.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

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

std::optional<float> SweptConvex::entry(const Sphere& ball, std::uint32_t /*element*/, const Vec3& displacement) const {
  const Vec3 grow(ball.radius, ball.radius, ball.radius);
  return entryIntoBox(lower_ - grow, upper_ + grow, ball.center, displacement);
}

void SweptConvex::appendNormals(std::uint32_t /*element*/, const Vec3& center, SeparatingNormals& normals) {
  normals.add(surface_.nearest(center).normal, false);
}

}  // namespace cairn::bullet
