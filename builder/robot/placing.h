// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Rounding of a ball's way into its link's frame, or back, as a part of the lengths involved: a scalar product of
/// three terms and a sum are off by 2^-51 of them, entries of the rotation by 2^-52 each.
inline constexpr double kPlacing = 0x1p-49;

inline double sizeOf(const Vec3d& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// By how much a ball may be off after its way between the frames of a shape and its link, whose origins lie `origin`
/// apart; metres.
inline double placingRounding(const Vec3d& center, const Vec3d& origin, double radius) {
  return kPlacing * (sizeOf(center) + sizeOf(origin) + radius);
}

}  // namespace cairn::builder
