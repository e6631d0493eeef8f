// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "spheres/ball.h"
#include "spheres/depth_field.h"
#include "spheres/point_set.h"

namespace cairn::builder {

using SphereSet = std::vector<Ball>;

/// Cover `points` with at most `count` balls of small stand-off. The reductions (merge, expand) and the optimisation
/// are pure functions of this.
struct CoverProblem {
  const PointSet& points;  ///< on the surface, mesh frame; not empty
  const DepthField& solid;
  std::size_t count = 8;  ///< at least 1
};

/// What a point costs a ball: the stand-off the ball needs to hold it, |p - c| - s(c).
inline double costOf(const Ball& ball, const Vec3d& point) {
  return distance(ball.center, point) - ball.depth;
}

/// Worst over the points of the least cost over the balls: the stand-off at which the set covers everything.
double coverStandOff(const PointSet& points, std::span<const Ball> balls);

}  // namespace cairn::builder
