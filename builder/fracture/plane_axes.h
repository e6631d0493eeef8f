// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "fracture/half_space.h"

namespace cairn::builder {

struct PlanePoint {
  double x = 0, y = 0;
};

/// Coordinates in a plane. Counter-clockwise is defined for a viewer at the tip of the normal.
class PlaneAxes {
 public:
  explicit PlaneAxes(const HalfSpace& plane)
      : u_(normalized(cross(plane.normal, std::abs(plane.normal.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}))),
        v_(cross(plane.normal, u_)) {}

  PlanePoint of(const Vec3d& x) const { return {dot(u_, x), dot(v_, x)}; }

 private:
  Vec3d u_, v_;
};

}  // namespace cairn::builder
