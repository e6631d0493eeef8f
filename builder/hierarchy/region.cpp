// SPDX-License-Identifier: GPL-3.0-or-later
#include "region.h"

#include <utility>
#include <vector>

#include "certify/protrusion.h"
#include "spheres/ball_fit.h"
#include "spheres/enclosing_ball.h"

namespace cairn::builder {

double errorOf(const Ball& ball, const SignedDistance& solid) {
  return certifiedProtrusion(solid, ball.center, ball.radius, defaultProtrusionTolerance(solid)).upper;
}

Region fittedRegion(const Ball& ball, Pieces pieces, const SignedDistance& solid, Refit refit) {
  const SolidDepth depth(solid);
  const std::vector<Vec3d> list = cornersOf(pieces);
  const PointSet corners(list);
  Ball kept = ballAround(refit == Refit::smallest ? smallestEnclosingBall(list).center : ball.center, corners, depth);
  double error = errorOf(kept, solid);
  if (refit == Refit::tightest) {
    const Ball fitted = fitBall(ball.center, corners, depth);
    const double fittedError = errorOf(fitted, solid);
    if (fittedError < error) {
      kept = fitted;
      error = fittedError;
    }
  }
  return {kept, error, std::move(pieces)};
}

}  // namespace cairn::builder
