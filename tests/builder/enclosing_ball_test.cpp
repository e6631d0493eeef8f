// SPDX-License-Identifier: GPL-3.0-or-later
#include "balls/enclosing_ball.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "random_tree.h"

namespace cairn::builder::enclosing_ball_test {
namespace {

// The library computes the support's circumsphere in double from up to four points; its condition is that of points of
// size 1 in general position, and ties (grid points) only make it better.
constexpr double kTolerance = 1e-9;

/// Circumsphere of two to four points within their affine hull; false when they are too nearly dependent.
bool circumsphere(const std::vector<Vec3d>& p, EnclosingBall& ball) {
  const std::size_t n = p.size() - 1;
  double m[3][4] = {};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) m[i][j] = 2 * dot(p[i + 1] - p[0], p[j + 1] - p[0]);
    m[i][n] = lengthSq(p[i + 1] - p[0]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t k = i + 1; k < n; ++k)
      if (std::abs(m[k][i]) > std::abs(m[pivot][i])) pivot = k;
    if (std::abs(m[pivot][i]) < 1e-12) return false;
    std::swap(m[i], m[pivot]);
    for (std::size_t k = 0; k < n; ++k)
      if (k != i)
        for (std::size_t j = n + 1; j-- > i;) m[k][j] -= m[i][j] * m[k][i] / m[i][i];
  }
  ball.center = p[0];
  for (std::size_t i = 0; i < n; ++i) ball.center += (p[i + 1] - p[0]) * (m[i][n] / m[i][i]);
  ball.radius = distance(ball.center, p[0]);
  return true;
}

bool holdsAll(const EnclosingBall& ball, const std::vector<Vec3d>& points) {
  for (const Vec3d& p : points)
    if (distance(p, ball.center) > ball.radius + kTolerance) return false;
  return true;
}

/// The smallest of the circumspheres of all subsets of two to four points that hold everything.
double smallestRadiusByTrial(const std::vector<Vec3d>& points) {
  double best = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::vector<Vec3d>& subset) {
    EnclosingBall ball;
    if (circumsphere(subset, ball) && ball.radius < best && holdsAll(ball, points)) best = ball.radius;
  };
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = a + 1; b < points.size(); ++b) {
      consider({points[a], points[b]});
      for (std::size_t c = b + 1; c < points.size(); ++c) {
        consider({points[a], points[b], points[c]});
        for (std::size_t d = c + 1; d < points.size(); ++d) consider({points[a], points[b], points[c], points[d]});
      }
    }
  return best;
}

TEST(EnclosingBall, RandomPoints_MatchesAllSubsets) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 engine(seed);
    std::vector<Vec3d> points(2 + engine() % 11);
    for (Vec3d& p : points) p = test::randomPoint(engine);
    const EnclosingBall ball = smallestEnclosingBall(points);
    EXPECT_TRUE(holdsAll(ball, points));
    EXPECT_NEAR(ball.radius, smallestRadiusByTrial(points), kTolerance);
  }
}

TEST(EnclosingBall, CosphericalAndRepeatedPoints_MatchesAllSubsets) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 engine(seed);
    std::vector<Vec3d> points(2 + engine() % 9);
    for (Vec3d& p : points) p = Vec3d(double(engine() % 3), double(engine() % 3), double(engine() % 2));
    points.push_back(points[0] + Vec3d(1, 0, 0));
    EXPECT_NEAR(smallestEnclosingBall(points).radius, smallestRadiusByTrial(points), kTolerance);
  }
}

TEST(EnclosingBall, OnePoint_HasRadiusZero) {
  const std::vector<Vec3d> point{{1, 2, 3}};
  const EnclosingBall ball = smallestEnclosingBall(point);
  EXPECT_EQ(ball.center, point[0]);
  EXPECT_EQ(ball.radius, 0);
}

}  // namespace
}  // namespace cairn::builder::enclosing_ball_test
