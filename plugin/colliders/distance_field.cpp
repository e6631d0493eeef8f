// SPDX-License-Identifier: Zlib
#include "colliders/distance_field.h"

#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "cairn/core/state_hash.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

// Fraction of the greatest coordinate by which the box is drawn in. Bullet splits the box into middle and extents and
// joins them again, which loses a few units in the last place.
constexpr float kInsetFraction = 1.0F / (1 << 20);

}  // namespace

const btSdfCollisionShape* asField(const btCollisionShape& shape) {
  const bool isField =
      shape.getShapeType() == SDF_SHAPE_PROXYTYPE && std::strcmp(shape.getName(), "btSdfCollisionShape") == 0;
  return isField ? static_cast<const btSdfCollisionShape*>(&shape) : nullptr;
}

void DistanceField::take(const btSdfCollisionShape& shape) {
  shape_ = const_cast<btSdfCollisionShape*>(&shape);
  btVector3 lower, upper;
  shape.getAabb(btTransform::getIdentity(), lower, upper);
  lower_ = toVec3(lower);
  upper_ = toVec3(upper);
  extent_ = 0;
  isEmpty_ = !isFinite(lower_) || !isFinite(upper_) || !isFinite(upper_ - lower_);
  if (isEmpty_) return;
  for (int axis = 0; axis < 3; ++axis) extent_ = std::max({extent_, std::abs(lower_[axis]), std::abs(upper_[axis])});
  const Vec3 in = Vec3(1, 1, 1) * (kInsetFraction * extent_);
  lower_ = lower_ + in;
  upper_ = upper_ - in;
  isEmpty_ = !(lower_.x < upper_.x && lower_.y < upper_.y && lower_.z < upper_.z);
}

float DistanceField::size() const {
  return isEmpty_ ? std::numeric_limits<float>::infinity() : length(upper_ - lower_);
}

std::uint64_t DistanceField::fingerprint() const {
  StateHash hash;
  if (isEmpty_) return hash.value();
  for (const Vec3& corner : {lower_, upper_})
    for (int axis = 0; axis < 3; ++axis) hash.add(corner[axis]);
  const Vec3 middle = 0.5F * (lower_ + upper_), quarter = 0.25F * (upper_ - lower_);
  for (const Vec3& offset : {Vec3(-1, -1, -1), Vec3(1, 1, -1), Vec3(1, -1, 1), Vec3(-1, 1, 1)}) {
    const std::optional<Sample> sample =
        query(middle + Vec3(offset.x * quarter.x, offset.y * quarter.y, offset.z * quarter.z));
    hash.add(sample ? sample->value : std::numeric_limits<float>::infinity());
  }
  return hash.value();
}

std::optional<DistanceField::Sample> DistanceField::query(const Vec3& p) const {
  btScalar value = 0;
  btVector3 gradient(0, 0, 0);
  if (!shape_->queryPoint(toBullet(p), value, gradient)) return std::nullopt;
  Sample sample{static_cast<float>(value), toVec3(gradient)};
  if (!std::isfinite(sample.value) || !isFinite(sample.gradient)) return std::nullopt;
  sample.least = std::max(sample.value, 0.0F) / kSteepest;
  return sample;
}

// Bullet takes NaN for a point of the domain, hence the check.
std::optional<DistanceField::Nearest> DistanceField::nearestInDomain(const Vec3& p) const {
  if (isEmpty_ || !isFinite(p)) return std::nullopt;
  Vec3 q;
  for (int axis = 0; axis < 3; ++axis) q[axis] = std::clamp(p[axis], lower_[axis], upper_[axis]);
  return Nearest{q, p - q, length(p - q)};
}

// The box is at most as far from an outside point as any point of the domain. From the box's nearest point, the two
// directions are at an obtuse angle. So the two distances add up at least like sides at a right angle.
std::optional<DistanceField::Sample> DistanceField::at(const Vec3& p) const {
  const std::optional<Nearest> nearest = nearestInDomain(p);
  if (!nearest) return std::nullopt;
  std::optional<Sample> sample = query(nearest->point);
  if (!sample || nearest->distance == 0) return sample;
  sample->isInDomain = false;
  sample->least = std::hypot(sample->least, nearest->distance);
  for (int axis = 0; axis < 3; ++axis)
    if (nearest->beyond[axis] != 0) sample->gradient[axis] = 0;
  const float inside = std::max(sample->value, 0.0F), apart = std::hypot(inside, nearest->distance);
  sample->gradient = (sample->gradient * inside + nearest->beyond) / apart;
  sample->value = apart + std::min(sample->value, 0.0F);
  return sample;
}

float DistanceField::leastDistance(const Vec3& p) const {
  const std::optional<Nearest> nearest = nearestInDomain(p);
  return nearest ? leastDistance(*nearest) : std::numeric_limits<float>::infinity();
}

float DistanceField::leastDistance(const Nearest& nearest) const {
  const std::optional<Sample> sample = query(nearest.point);
  return sample ? std::hypot(sample->least, nearest.distance) : nearest.distance;
}

bool DistanceField::isFarther(const Vec3& p, float distance) const {
  const std::optional<Nearest> nearest = nearestInDomain(p);
  return !nearest || nearest->distance > distance || leastDistance(*nearest) > distance;
}

}  // namespace cairn::bullet
