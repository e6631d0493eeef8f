// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// A ball that stands for a part of a solid's surface: mesh frame, mesh units.
struct Ball {
  Vec3d center;       ///< mesh frame
  double radius = 0;  ///< mesh unit
  double depth = 0;   ///< of the centre below the surface, negative outside: s(c) of the design

  /// How far the ball can stand off the solid: an upper bound by the triangle inequality, exact for convex solids
  /// (thesis Eq. 5.1). May be negative for a ball strictly inside.
  double standOff() const { return radius - depth; }
};

}  // namespace cairn::builder
