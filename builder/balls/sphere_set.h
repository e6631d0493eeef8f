// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "balls/depth_field.h"
#include "balls/piece.h"
#include "balls/point_set.h"
#include "cairn/builder/ball.h"

namespace cairn::builder {

using SphereSet = std::vector<Ball>;

/// The task: cover `points` with at most `count` balls of small stand-off. The reductions (merge, expand) and the
/// optimisation are pure functions of it.
struct CoverProblem {
  const PointSet& points;  ///< on the surface, mesh frame; not empty
  const DepthField& solid;
  std::size_t count = 8;  ///< at least 1
};

/// The cost of a point for a ball: the stand-off that the ball needs to hold the point, |p - c| - s(c).
inline double costOf(const Ball& ball, const Vec3d& point) {
  return distance(ball.center, point) - ball.depth;
}

/// The cost of a piece for a ball: the cost of its costliest corner, because a ball is convex.
inline double costOf(const Ball& ball, const Piece& piece) {
  const auto distanceSq = [&](int i) { return lengthSq(ball.center - piece.corners[i]); };
  return std::sqrt(std::max({distanceSq(0), distanceSq(1), distanceSq(2)})) - ball.depth;
}

/// Returns the stand-off at which the set covers all points: the largest, over the points, of the least cost over the
/// balls.
double coverStandOff(const PointSet& points, std::span<const Ball> balls);

/// Scale of the closing in which a set is fitted, as a fraction of the stand-off to be lowered. The scale lies below
/// the final stand-off and above the scale of narrow concavities. See `ClosedDepth`.
inline constexpr double kClosingScale = 0.85;
/// Spacing of the samples of that closing, mesh unit. A sample missed by half the spacing h makes a ball of radius R
/// seem about h^2 / (8 R) too small to reach it. The spacing keeps this to 1 % of the stand-off. Precondition: `balls`
/// is not empty.
double closingSpacing(std::span<const Ball> balls, double standOff);

}  // namespace cairn::builder
