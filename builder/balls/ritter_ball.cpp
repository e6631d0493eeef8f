// SPDX-License-Identifier: GPL-3.0-or-later
#include "ritter_ball.h"

#include <algorithm>
#include <cassert>

namespace cairn::builder {

EnclosingBall ritterBall(std::span<const Vec3d> points) {
  assert(!points.empty());
  EnclosingBall ball{points[0], 0};
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                                 [axis](const Vec3d& a, const Vec3d& b) { return a[axis] < b[axis]; });
    const double radius = 0.5 * distance(*low, *high);
    if (radius > ball.radius) ball = {(*low + *high) * 0.5, radius};
  }
  for (const Vec3d& p : points) {
    const double d = distance(p, ball.center);
    if (d <= ball.radius) continue;
    const double radius = 0.5 * (ball.radius + d);
    ball.center += (p - ball.center) * ((d - radius) / d);
    ball.radius = radius;
  }
  // Rounding may leave a point of the surface outside. The final pass makes the ball hold all points.
  for (const Vec3d& p : points) ball.radius = std::max(ball.radius, distance(p, ball.center));
  return ball;
}

}  // namespace cairn::builder
