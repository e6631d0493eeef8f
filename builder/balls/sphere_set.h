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

/// What a piece costs a ball: what its costliest corner does, since a ball is convex.
inline double costOf(const Ball& ball, const Piece& piece) {
  const auto distanceSq = [&](int i) { return lengthSq(ball.center - piece.corners[i]); };
  return std::sqrt(std::max({distanceSq(0), distanceSq(1), distanceSq(2)})) - ball.depth;
}

/// Worst over the points of the least cost over the balls: the stand-off at which the set covers everything.
double coverStandOff(const PointSet& points, std::span<const Ball> balls);

/// Scale of the closing a set is fitted in, in parts of the stand-off it is to lower: below the stand-off reached in
/// the end, and above what narrow concavities need. See `ClosedDepth`.
inline constexpr double kClosingScale = 0.85;
/// Spacing of that closing's samples: a sample missed by half the spacing h makes a ball of radius R look about
/// h^2 / (8 R) too small to reach it, which is kept to 1 % of the stand-off. Precondition: `balls` not empty.
double closingSpacing(std::span<const Ball> balls, double standOff);

}  // namespace cairn::builder
