// SPDX-License-Identifier: GPL-3.0-or-later
#include "region.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "balls/ball_fit.h"
#include "balls/enclosing_ball.h"
#include "balls/sphere_set.h"
#include "certify/protrusion.h"
#include "surface/infinity.h"

namespace cairn::builder {

namespace {

struct CertifiedBall {
  Ball ball;
  double error = 0;
};

/// The balls around one part of the surface, each with its certified error. An error above `ofInterest` is only known
/// to be larger.
class PartFit {
 public:
  PartFit(const Pieces& pieces, const SignedDistance& solid)
      : solid_(solid), depth_(solid), list_(cornersOf(pieces)), corners_(list_) {}

  CertifiedBall around(const Vec3d& center, double ofInterest = kInfinity) const {
    return certified(ballAround(center, corners_, depth_), ofInterest);
  }
  CertifiedBall smallest() const { return around(smallestEnclosingBall(list_).center); }
  CertifiedBall tightest(const Vec3d& center, double ofInterest = kInfinity) const {
    return certified(fitBall(center, corners_, depth_), ofInterest);
  }

  /// Fits in the closing of the solid at about the error of `start`, so that narrow concavities are not charged.
  CertifiedBall closed(const CertifiedBall& start) const {
    if (start.error <= 0) return start;
    const ClosedDepth field(solid_, kClosingScale * start.error, closingSpacing(std::span(&start.ball, 1), start.error),
                            start.ball.center, start.ball.radius + 2 * start.error);
    if (!field.usable()) return start;
    return around(fitBall(start.ball.center, corners_, field).center);
  }

 private:
  CertifiedBall certified(const Ball& ball, double ofInterest) const {
    ProtrusionTolerance tolerance = defaultProtrusionTolerance(solid_);
    tolerance.ofInterest = ofInterest;
    return {ball, certifiedProtrusion(solid_, ball.center, ball.radius, tolerance).upper};
  }

  const SignedDistance& solid_;
  SolidDepth depth_;
  std::vector<Vec3d> list_;
  PointSet corners_;
};

/// The first one on a tie.
CertifiedBall better(const CertifiedBall& a, const CertifiedBall& b) {
  return b.error < a.error ? b : a;
}

CertifiedBall fitted(const PartFit& part, const Vec3d& center, Refit refit, double ofInterest) {
  if (refit == Refit::none) return part.around(center, ofInterest);
  if (refit == Refit::smallest) return part.smallest();
  if (refit == Refit::tightest) {
    // The moved ball is mostly the better one, and the search for the other one's error soon ends.
    const CertifiedBall moved = part.tightest(center, ofInterest);
    return better(part.around(center, std::min(moved.error, ofInterest)), moved);
  }
  const CertifiedBall least = better(part.smallest(), part.tightest(center));
  return better(least, part.closed(least));
}

}  // namespace

double errorOf(const Ball& ball, const SignedDistance& solid) {
  return certifiedProtrusion(solid, ball.center, ball.radius, defaultProtrusionTolerance(solid)).upper;
}

Region fittedRegion(const Ball& ball, Pieces pieces, const SignedDistance& solid, Refit refit, double ofInterest) {
  const CertifiedBall kept = fitted(PartFit(pieces, solid), ball.center, refit, ofInterest);
  return {kept.ball, kept.error, std::move(pieces)};
}

}  // namespace cairn::builder
