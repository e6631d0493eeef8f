// SPDX-License-Identifier: Zlib
#pragma once

#include <cmath>
#include <limits>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Of length one, to some units of rounding, however short `v` is: below 1e-19 its square has few digits left, or none.
/// Zero for zero.
inline Vec3 unitVector(const Vec3& v) {
  const float squared = lengthSq(v);
  if (squared >= std::numeric_limits<float>::min()) return v / std::sqrt(squared);
  const Vec3d exact(v);
  const double norm = length(exact);
  return norm > 0 ? Vec3(exact / norm) : Vec3();
}

/// Directions closer than this, in radians, are one: over a metre they are a hundredth of a millimetre apart.
inline constexpr float kSameDirection = 1e-5F;

/// Whether what was measured along one unit vector holds for the other.
inline bool isSameNormal(const Vec3& x, const Vec3& y) {
  return lengthSq(x - y) < kSameDirection * kSameDirection;
}

}  // namespace cairn::bullet
