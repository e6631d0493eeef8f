// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace cairn::bench {

using Point2 = std::array<double, 2>;

/// Corners of the convex hull, counterclockwise, none on a line between its neighbours (Andrew 1979). O(n log n).
inline std::vector<Point2> hullOf(std::vector<Point2> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto turnsLeft = [](const Point2& a, const Point2& b, const Point2& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0;
  };
  std::vector<Point2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= first + 2 && !turnsLeft(hull[hull.size() - 2], hull.back(), p)) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Direction of the longer side of the rectangle of least area around the points: a side of it lies along a side of
/// their hull (Freeman and Shapira 1975). Linear in hull corners times hull sides. Precondition: a point at least.
inline Point2 directionOfLeastRectangle(const std::vector<Point2>& points) {
  const std::vector<Point2> hull = hullOf(points);
  Point2 best{1, 0};
  double leastArea = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    const double norm = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (!(norm > 0)) continue;
    const Point2 along{(b[0] - a[0]) / norm, (b[1] - a[1]) / norm};
    std::array<double, 4> ends{0, 0, 0, 0};  // least and most along, least and most across, from corner a
    for (const Point2& p : hull) {
      const double x = (p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1];
      const double y = (p[1] - a[1]) * along[0] - (p[0] - a[0]) * along[1];
      ends = {std::min(ends[0], x), std::max(ends[1], x), std::min(ends[2], y), std::max(ends[3], y)};
    }
    const double width = ends[1] - ends[0], height = ends[3] - ends[2];
    if (!(width * height < leastArea)) continue;
    leastArea = width * height;
    best = width >= height ? along : Point2{-along[1], along[0]};
  }
  return best;
}

}  // namespace cairn::bench
