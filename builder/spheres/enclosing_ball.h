// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "cairn/core/vec3.h"

namespace cairn::builder {

struct EnclosingBall {
  Vec3d center;
  double radius = 0;
};

/// The smallest ball that holds the points (CGAL's Min_sphere_of_spheres_d; Fischer and Gaertner 2003). The centre is
/// exact up to rounding; the radius is the largest distance measured from it. Expected linear time. Precondition: not
/// empty.
EnclosingBall smallestEnclosingBall(std::span<const Vec3d> points);

}  // namespace cairn::builder
