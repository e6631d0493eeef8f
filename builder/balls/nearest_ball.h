// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "balls/enclosing_ball.h"

namespace cairn::builder {

/// Finds the ball nearest to a point among many; the distance is |p - c| - r. A tree of boxes around the centres, split
/// at the median. Safe to query from many threads.
class NearestBall {
 public:
  /// Precondition: `balls` is not empty. O(n log n).
  explicit NearestBall(std::vector<EnclosingBall> balls);

  /// Returns the index of the nearest ball, the lowest on a tie.
  std::size_t to(const Vec3d& point) const;

 private:
  struct Node {
    Vec3d lower, upper;                // bounds of the centres
    double radius = 0;                 // the largest
    std::uint32_t begin = 0, end = 0;  // range in `order_`
    std::uint32_t right = 0;           // second child; the first child follows its parent; 0 for a leaf
  };
  struct Best {
    double distance;
    std::uint32_t ball;
  };
  void build(std::uint32_t begin, std::uint32_t end);
  static double bound(const Node& node, const Vec3d& point);
  void search(std::uint32_t node, const Vec3d& point, Best& best) const;

  std::vector<EnclosingBall> balls_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace cairn::builder
