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

}  // namespace cairn::bullet
