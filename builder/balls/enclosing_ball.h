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

/// Returns the smallest ball that holds the points (CGAL's Min_sphere_of_spheres_d; Fischer and Gaertner 2003). The
/// centre is exact up to rounding. The radius is the largest distance measured from that centre. Expected linear time.
/// Precondition: `points` is not empty.
EnclosingBall smallestEnclosingBall(std::span<const Vec3d> points);

/// `smallestEnclosingBall` for many small sets of points. It reuses its memory, because allocation would take a
/// noticeable part of the time. Gives the same bits as `smallestEnclosingBall`. Not thread-safe.
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
