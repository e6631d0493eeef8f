// SPDX-License-Identifier: GPL-3.0-or-later
#include "balls/farthest_sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace cairn::builder {

namespace {

constexpr std::uint32_t kBoxPoints = 64;

/// The points by boxes, and the squared distance of each from the nearest point taken.
class Boxes {
 public:
  explicit Boxes(std::span<const Vec3d> points)
      : points_(points), order_(points.size()), nearestSq_(points.size(), std::numeric_limits<double>::infinity()) {
    std::iota(order_.begin(), order_.end(), 0U);
    build(0, static_cast<std::uint32_t>(order_.size()));
    for (const std::uint32_t i : order_) sorted_.push_back(points[i]);
  }

  /// Takes a point.
  void take(const Vec3d& point) {
    for (Box& box : boxes_) {
      // Rounding is monotone, so the computed distance of a box is a lower bound for its points.
      if (distanceSq(box, point) >= box.farthestSq) continue;
      box.farthestSq = 0;
      for (std::uint32_t i = box.begin; i < box.end; ++i) {
        nearestSq_[i] = std::min(nearestSq_[i], lengthSq(sorted_[i] - point));
        box.farthestSq = std::max(box.farthestSq, nearestSq_[i]);
      }
    }
  }

  /// The point farthest from those taken, and its squared distance. Distances that are equal after rounding tie.
  std::pair<std::size_t, double> farthest() const {
    double mostSq = 0;
    for (const Box& box : boxes_) mostSq = std::max(mostSq, box.farthestSq);
    double tieSq = mostSq;
    for (double lower = mostSq; std::sqrt(lower) == std::sqrt(mostSq) && lower > 0; lower = std::nextafter(lower, 0.0))
      tieSq = lower;
    std::size_t index = points_.size();
    for (const Box& box : boxes_) {
      if (box.farthestSq < tieSq) continue;
      for (std::uint32_t i = box.begin; i < box.end; ++i)
        if (nearestSq_[i] >= tieSq) index = std::min<std::size_t>(index, order_[i]);
    }
    return {index, mostSq};
  }

 private:
  struct Box {
    std::uint32_t begin = 0, end = 0;
    Vec3d lower, upper;
    double farthestSq = std::numeric_limits<double>::infinity();  // largest `nearestSq_` in it
  };

  static double distanceSq(const Box& box, const Vec3d& point) {
    Vec3d gap;
    for (int axis = 0; axis < 3; ++axis)
      gap[axis] = std::max({box.lower[axis] - point[axis], point[axis] - box.upper[axis], 0.0});
    return lengthSq(gap);
  }

  void build(std::uint32_t begin, std::uint32_t end) {
    Box box{begin, end, points_[order_[begin]], points_[order_[begin]]};
    for (std::uint32_t i = begin; i < end; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], points_[order_[i]][axis]);
        box.upper[axis] = std::max(box.upper[axis], points_[order_[i]][axis]);
      }
    if (end - begin <= kBoxPoints) {
      boxes_.push_back(box);
      return;
    }
    const Vec3d extent = box.upper - box.lower;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b);
                     });
    build(begin, middle);
    build(middle, end);
  }

  std::span<const Vec3d> points_;
  std::vector<std::uint32_t> order_;  // by boxes
  std::vector<Vec3d> sorted_;         // the points in this order
  std::vector<double> nearestSq_;     // in this order
  std::vector<Box> boxes_;
};

}  // namespace

std::vector<Vec3d> farthestPointSample(std::span<const Vec3d> points, std::size_t count, std::size_t first) {
  if (points.size() <= count) return {points.begin(), points.end()};
  Boxes boxes(points);
  std::vector<Vec3d> sample;
  std::size_t next = first;
  while (sample.size() < count) {
    sample.push_back(points[next]);
    boxes.take(points[next]);
    const auto [index, distanceSq] = boxes.farthest();
    if (distanceSq == 0) break;
    next = index;
  }
  return sample;
}

}  // namespace cairn::builder
