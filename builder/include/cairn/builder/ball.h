// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// A ball that represents a part of a solid's surface. Mesh frame, mesh units.
///
///     Ball ball{.center = c, .radius = r, .depth = depthBelowSurface};
///     double worst = ball.standOff(); // no point of the ball is farther from the solid
struct Ball {
  Vec3d center;       ///< mesh frame
  double radius = 0;  ///< mesh unit
  double depth = 0;   ///< of the centre below the surface, negative outside; s(c) in the design

  /// An upper bound of the distance from any point of the ball to the solid, by the triangle inequality. It is exact
  /// for convex solids (thesis Eq. 5.1). It may be negative for a ball strictly inside.
  double standOff() const { return radius - depth; }
};

}  // namespace cairn::builder
