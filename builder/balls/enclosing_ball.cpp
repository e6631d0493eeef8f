// SPDX-License-Identifier: GPL-3.0-or-later
#include "enclosing_ball.h"

#include <CGAL/Min_sphere_of_spheres_d.h>

#include <algorithm>
#include <cassert>

namespace cairn::builder {

namespace {

/// Tells CGAL's algorithm that our points are spheres of radius zero.
struct PointTraits {
  static constexpr int D = 3;
  using FT = double;
  using Sphere = Vec3d;
  using LP_algorithm = CGAL::Tag_false;
  using Use_square_roots = CGAL::Tag_false;
  using Algorithm = CGAL::Farthest_first_heuristic;
  using Cartesian_const_iterator = const double*;

  static const double* center_cartesian_begin(const Vec3d& p) { return &p.x; }
  static double radius(const Vec3d&) { return 0; }
};
static_assert(sizeof(Vec3d) == 3 * sizeof(double), "the traits walk over the coordinates");

using SmallestSphere = CGAL::Min_sphere_of_spheres_d<PointTraits>;

EnclosingBall ballOf(SmallestSphere& smallest, std::span<const Vec3d> points) {
  const auto coordinate = smallest.center_cartesian_begin();
  EnclosingBall ball{{coordinate[0], coordinate[1], coordinate[2]}, 0};
  double farthestSq = 0;
  for (const Vec3d& p : points) farthestSq = std::max(farthestSq, lengthSq(p - ball.center));
  ball.radius = std::sqrt(farthestSq);
  return ball;
}

}  // namespace

EnclosingBall smallestEnclosingBall(std::span<const Vec3d> points) {
  assert(!points.empty());
  SmallestSphere smallest(points.begin(), points.end());
  return ballOf(smallest, points);
}

struct EnclosingBallSearch::Search {
  SmallestSphere smallest;
};

EnclosingBallSearch::EnclosingBallSearch() : search_(std::make_unique<Search>()) {}
EnclosingBallSearch::~EnclosingBallSearch() = default;

EnclosingBall EnclosingBallSearch::around(std::span<const Vec3d> points) {
  assert(!points.empty());
  search_->smallest.set(points.begin(), points.end());
  return ballOf(search_->smallest, points);
}

}  // namespace cairn::builder
