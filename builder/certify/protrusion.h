// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "surface/signed_distance.h"

namespace cairn::builder {

/// How far a ball sticks out of the solid: the largest distance from a point of the ball to the solid, enclosed from
/// both sides. Mesh frame and unit.
struct CertifiedProtrusion {
  double upper = 0;  ///< no point of the ball is farther from the solid, rounding included
  double lower = 0;  ///< `witness` is at least this far, rounding included
  Vec3d witness;     ///< a point of the ball
  double depth = 0;  ///< s(center): positive inside
};

/// How closely `certifiedProtrusion` encloses the truth: it stops when upper <= lower * (1 + relative) + absolute,
/// after `maxQueries` distance queries, or at a point farther from the solid than `ofInterest` (then the bounds are as
/// valid, only farther apart; `upper` is more than `ofInterest`, as it would be in the end).
struct ProtrusionTolerance {
  double relative = 0.01;
  double absolute = 0;  ///< mesh unit
  std::uint32_t maxQueries = 100'000;
  double ofInterest = std::numeric_limits<double>::infinity();  ///< mesh unit
};

/// What `certify` and the construction ask for: 1 % of the error, but not below 1e-4 of the bounding box's diagonal.
ProtrusionTolerance defaultProtrusionTolerance(const SignedDistance& solid);

/// Starts from max(0, R - s(c)), which one query proves (B(c, s) lies in the solid), and tightens it by best-first
/// branch and bound over pieces of the ball. A piece is a patch of directions times an interval of radii; it lies in
/// the convex hull of six points, so the distance to any one triangle, a convex function, is largest at one of the six,
/// and the distance to the solid is no larger. Precondition: radius >= 0, all finite. Deterministic. Some hundred
/// queries for a typical ball.
CertifiedProtrusion certifiedProtrusion(const SignedDistance& solid, const Vec3d& center, double radius,
                                        const ProtrusionTolerance& tolerance);

/// `upper` of the above with an absolute tolerance in mesh units beside the relative 1 %.
double protrusionBound(const SignedDistance& solid, const Vec3d& center, double radius, double tolerance);

}  // namespace cairn::builder
