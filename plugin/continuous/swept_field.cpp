// SPDX-License-Identifier: Zlib
#include "continuous/swept_field.h"

#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>

#include <limits>

namespace cairn::bullet {

namespace {
// Each step leaves a third of the distance to a surface straight ahead.
constexpr int kMaxSteps = 16;
// Fraction of the ball's radius within which the surface counts as reached.
constexpr float kNearFraction = 0.01F;
}  // namespace

void SweptField::take(const btCollisionShape& shape, const btVector3& /*lower*/, const btVector3& /*upper*/) {
  field_.take(static_cast<const btSdfCollisionShape&>(shape));
  normal_ = onPlane_ = {};
}

float SweptField::radius(std::uint32_t /*element*/) const {
  return std::numeric_limits<float>::infinity();
}

std::optional<float> SweptField::entry(const Sphere& ball, std::uint32_t /*element*/, const Vec3& displacement) const {
  const float norm = length(displacement);
  float travelled = 0;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Vec3 center = travelled > 0 ? ball.center + displacement * (travelled / norm) : ball.center;
    const float apart = field_.leastDistance(center) - ball.radius;
    if (apart <= kNearFraction * ball.radius) break;
    travelled += apart;
    if (travelled > norm) return std::nullopt;
  }
  return travelled > 0 ? travelled / norm : 0.0F;
}

// Other directions are unknown.
Vec3 SweptField::support(std::uint32_t /*element*/, const Vec3& direction) const {
  return dot(normal_, direction) > 0.999F ? onPlane_ : direction * kInfiniteExtent;
}

void SweptField::appendNormals(std::uint32_t /*element*/, const Vec3& center, SeparatingNormals& normals) {
  normal_ = {};
  const std::optional<DistanceField::Sample> sample = field_.at(center);
  if (!sample || !sample->hasDirection()) return;
  normal_ = normalized(sample->gradient);
  onPlane_ = center - normal_ * sample->height();
  normals.add(normal_, true);
}

}  // namespace cairn::bullet
