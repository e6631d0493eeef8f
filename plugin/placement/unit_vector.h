// SPDX-License-Identifier: Zlib
#pragma once

#include <cmath>
#include <limits>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// `v` with length 1, within some units of rounding, however short `v` is. Below a length of 1e-19 a float's square has
/// few digits or none, so double is used. Zero for zero.
inline Vec3 unitVector(const Vec3& v) {
  const float squared = lengthSq(v);
  if (squared >= std::numeric_limits<float>::min()) return v / std::sqrt(squared);
  const Vec3d exact(v);
  const double norm = length(exact);
  return norm > 0 ? Vec3(exact / norm) : Vec3();
}

/// Radians. Directions closer than this are equal: over a metre they differ by a hundredth of a millimetre.
inline constexpr float kSameDirection = 1e-5F;

/// Whether a measurement along one unit vector holds for the other.
inline bool isSameNormal(const Vec3& x, const Vec3& y) {
  return lengthSq(x - y) < kSameDirection * kSameDirection;
}

}  // namespace cairn::bullet
