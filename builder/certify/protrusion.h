// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "surface/signed_distance.h"

namespace cairn::builder {

/// The protrusion of a ball: the largest distance from the solid to a point of the ball, enclosed from both sides. Mesh
/// frame and unit.
struct CertifiedProtrusion {
  double upper = 0;  ///< no point of the ball is farther from the solid, rounding included
  double lower = 0;  ///< `witness` is at least this far from the solid, rounding included
  Vec3d witness;     ///< a point of the ball
  double depth = 0;  ///< s(center): positive inside
};

/// The end conditions of `certifiedProtrusion`. It stops when upper <= lower * (1 + relative) + absolute, after
/// `maxQueries` distance queries, or at a point farther from the solid than `ofInterest`. The bounds are then valid
/// too, but less tight. In the last case `upper` exceeds `ofInterest`, as the final bound would.
struct ProtrusionTolerance {
  double relative = 0.01;
  double absolute = 0;  ///< mesh unit
  std::uint32_t maxQueries = 100'000;
  double ofInterest = std::numeric_limits<double>::infinity();  ///< mesh unit
};

/// The tolerance of `certify` and of the construction: 1 % of the error, but not below 1e-4 of the bounding box's
/// diagonal.
ProtrusionTolerance defaultProtrusionTolerance(const SignedDistance& solid);

/// Encloses the protrusion of one ball. It starts from max(0, R - s(c)), which one query proves, because B(c, s) lies
/// in the solid. Best-first branch and bound over pieces of the ball then tightens it.
///
/// A piece is a patch of directions times an interval of radii; it lies in the convex hull of six points. The distance
/// to one triangle is a convex function, so its largest value on the hull is at one of the six points. The distance to
/// the solid is no larger.
///
/// Preconditions: radius >= 0, all numbers finite. Deterministic. Cost: some hundred queries for a typical ball.
///
///     double upper = certifiedProtrusion(distance, c, r, defaultProtrusionTolerance(distance)).upper;
CertifiedProtrusion certifiedProtrusion(const SignedDistance& solid, const Vec3d& center, double radius,
                                        const ProtrusionTolerance& tolerance);

/// Returns `upper` of `certifiedProtrusion` for a relative tolerance of 1 % and an absolute `tolerance` in mesh units.
double protrusionBound(const SignedDistance& solid, const Vec3d& center, double radius, double tolerance);

}  // namespace cairn::builder
