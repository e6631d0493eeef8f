// SPDX-License-Identifier: GPL-3.0-or-later
#include "region.h"

#include <utility>

#include "certify/protrusion.h"
#include "spheres/ball_fit.h"

namespace cairn::builder {

double errorOf(const Ball& ball, const SignedDistance& solid) {
  return certifiedProtrusion(solid, ball.center, ball.radius, defaultProtrusionTolerance(solid)).upper;
}

Region fittedRegion(const Ball& ball, Pieces pieces, const SignedDistance& solid) {
  const SolidDepth depth(solid);
  const PointSet corners(cornersOf(pieces));
  const Ball kept = ballAround(ball.center, corners, depth), fitted = fitBall(ball.center, corners, depth);
  const double keptError = errorOf(kept, solid), fittedError = errorOf(fitted, solid);
  if (fittedError < keptError) return {fitted, fittedError, std::move(pieces), {}};
  return {kept, keptError, std::move(pieces), {}};
}

}  // namespace cairn::builder
