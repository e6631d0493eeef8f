// SPDX-License-Identifier: Zlib
#include "contacts/relative_motion.h"

#include <cmath>

namespace cairn::bullet {

namespace {

// By the vector's length in radians around it (Rodrigues).
Mat3 rotationBy(const Vec3& turn) {
  const float angle = length(turn);
  if (angle == 0) return {};
  const Vec3 axis = turn / angle;
  const float s = std::sin(angle), c = std::cos(angle);
  Mat3 rotation;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation(i, j) = (1 - c) * axis[i] * axis[j] + (i == j ? c : 0.0F);
  const Mat3 crossed{{Vec3{0, -axis.z, axis.y}, Vec3{axis.z, 0, -axis.x}, Vec3{-axis.y, axis.x, 0}}};
  for (int i = 0; i < 3; ++i)
    rotation.rows[static_cast<std::size_t>(i)] += s * crossed.rows[static_cast<std::size_t>(i)];
  return rotation;
}

}  // namespace

Similarity RelativeMotion::backOneStep() const {
  const Mat3 treeBack = rotationBy(-timeStep * treeAngular), otherOn = rotationBy(timeStep * otherAngular);
  // p -> otherCenter + otherOn (treeCenter - v dt + treeBack (p - treeCenter) - (otherCenter - w dt))
  const Vec3 apart =
      treeCenter - timeStep * treeLinear - treeBack * treeCenter - (otherCenter - timeStep * otherLinear);
  return {otherOn * treeBack, otherCenter + otherOn * apart, 1};
}

}  // namespace cairn::bullet
