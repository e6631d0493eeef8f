// SPDX-License-Identifier: GPL-3.0-or-later
#include "certify/ball_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cairn::builder {
namespace {

double maxCoordinate(const Vec3d& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

BallDistances::BallDistances(std::span<const Ball> balls, const Bounds& bounds) : balls_(balls), all_(balls.size()) {
  std::iota(all_.begin(), all_.end(), 0U);
  double reach = std::max(maxCoordinate(bounds.lower), maxCoordinate(bounds.upper));
  for (const Ball& ball : balls) reach = std::max(reach, maxCoordinate(ball.center) + ball.radius);
  // As derived in `CoverProof`: differences, squares, the root and up to 52 halvings of an edge stay below 256 units of
  // the last place of the largest coordinate.
  guard_ = 0x1p-45 * reach;
}

double BallDistances::nearest(const Vec3d& point, std::span<const std::uint32_t> among) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : among) least = std::min(least, distance(point, balls_[i].center) - balls_[i].radius);
  return least;
}

double BallDistances::gather(const Vec3d& point, double reach, std::span<const std::uint32_t> among,
                             Names& near) const {
  const double least = nearest(point, among);
  near.clear();
  // Distances change by at most `reach` on the way, that of the nearest and that of another.
  const double within = least + 2 * (reach + guard_);
  for (const std::uint32_t i : among)
    if (distance(point, balls_[i].center) - balls_[i].radius <= within) near.push_back(i);
  return least;
}

double BallDistances::most(std::span<const Vec3d> corners, std::span<const std::uint32_t> among) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : among) {
    double farthestSq = 0;
    for (const Vec3d& corner : corners) farthestSq = std::max(farthestSq, lengthSq(corner - balls_[i].center));
    least = std::min(least, std::sqrt(farthestSq) - balls_[i].radius);
  }
  return least;
}

}  // namespace cairn::builder
