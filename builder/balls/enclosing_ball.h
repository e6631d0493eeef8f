// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn::builder {

struct EnclosingBall {
  Vec3d center;
  double radius = 0;
};

/// The smallest ball that holds the points (CGAL's Min_sphere_of_spheres_d; Fischer and Gaertner 2003). The centre is
/// exact up to rounding; the radius is the largest distance measured from it. Expected linear time. Precondition: not
/// empty.
EnclosingBall smallestEnclosingBall(std::span<const Vec3d> points);

/// `smallestEnclosingBall` many times for few points, where memory taken anew each time would cost a part. The same
/// bits. For one thread.
class EnclosingBallSearch {
 public:
  EnclosingBallSearch();
  ~EnclosingBallSearch();
  EnclosingBall around(std::span<const Vec3d> points);

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace cairn::builder
