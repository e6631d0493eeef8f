// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "flat/settle_radii.h"

namespace cairn::builder {
namespace {

/// What a radius is smaller than the depth of its centre, in bounds of the rounding of a distance: the proof takes two.
constexpr double kGuards = 4;

/// A point in the solid near the ball's centre, which is outside or on the surface: on from the nearest surface point
/// in the same direction, as far as that gets deeper.
Vec3d insideNear(const Ball& ball, const SignedDistance& solid) {
  const SignedDistance::Answer answer = solid.query(ball.center);
  const auto c = solid.mesh().corners(answer.nearest.triangle);
  const Vec3d inward = -normalized(cross(c[1] - c[0], c[2] - c[0]));
  const Vec3d middle = (c[0] + c[1] + c[2]) / 3.0;
  Vec3d best = middle;
  double deepest = 0;
  const double diagonal = solid.bounds().diagonal();
  for (double step = 0.1 * diagonal; step > 1e-7 * diagonal; step *= 0.7)
    for (const Vec3d& from : {answer.nearest.point, middle}) {
      const Vec3d trial = from + inward * step;
      const double depth = solid.depth(trial);
      if (depth <= 0.5 * step || depth <= deepest) continue;
      deepest = depth;
      best = trial;
    }
  return best;
}

}  // namespace

SphereSet innerRadii(SphereSet balls, const SignedDistance& solid) {
  const double least = 1e-7 * solid.bounds().diagonal();
  for (Ball& ball : balls) {
    ball.depth = solid.depth(ball.center);
    if (ball.depth <= least) {
      ball.center = insideNear(ball, solid);
      ball.depth = solid.depth(ball.center);
    }
    ball.radius = ball.depth - kGuards * solid.roundingBound(ball.center);
  }
  return balls;
}

}  // namespace cairn::builder
