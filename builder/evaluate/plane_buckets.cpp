// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/plane_buckets.h"

#include <algorithm>
#include <cmath>

namespace cairn::builder {
namespace {

constexpr double kMaxSide = 1024;  // 4 MB of cells

Rectangle hullOf(std::span<const Rectangle> rectangles) {
  if (rectangles.empty()) return {};
  Rectangle hull = rectangles.front();
  for (const Rectangle& r : rectangles) {
    for (int axis = 0; axis < 2; ++axis) {
      hull.lower[axis] = std::min(hull.lower[axis], r.lower[axis]);
      hull.upper[axis] = std::max(hull.upper[axis], r.upper[axis]);
    }
  }
  return hull;
}

}  // namespace

PlaneBuckets::PlaneBuckets(std::span<const Rectangle> rectangles) : bounds_(hullOf(rectangles)) {
  const double wanted = std::ceil(std::sqrt(static_cast<double>(rectangles.size())));
  side_ = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, kMaxSide));
  while (side_ > 1 && entriesFor(rectangles) > kMaxPerRectangle * rectangles.size()) side_ /= 2;
  first_.assign(std::size_t{side_} * side_ + 1, 0);
  for (const Rectangle& r : rectangles) forCells(r, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  list_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < rectangles.size(); ++i)
    forCells(rectangles[i], [&](std::size_t cell) { list_[next[cell]++] = i; });
}

/// Number of entries in all lists for the present size of cells.
std::size_t PlaneBuckets::entriesFor(std::span<const Rectangle> rectangles) const {
  std::size_t sum = 0;
  for (const Rectangle& r : rectangles) {
    const auto from = cellOf(r.lower), to = cellOf(r.upper);
    sum += std::size_t{to[0] - from[0] + 1} * (to[1] - from[1] + 1);
  }
  return sum;
}

/// Rounds alike for queries and rectangles, and never falls as a coordinate grows. So rounding cannot move a point out
/// of the cells of a rectangle that holds it.
std::array<std::uint32_t, 2> PlaneBuckets::cellOf(const std::array<double, 2>& point) const {
  std::array<std::uint32_t, 2> cell{};
  for (int axis = 0; axis < 2; ++axis) {
    const double extent = bounds_.upper[axis] - bounds_.lower[axis];
    const double position = extent > 0 ? (point[axis] - bounds_.lower[axis]) / extent * side_ : 0;
    cell[axis] = static_cast<std::uint32_t>(std::clamp(position, 0.0, side_ - 1.0));
  }
  return cell;
}

template <class Visit>
void PlaneBuckets::forCells(const Rectangle& rectangle, const Visit& visit) const {
  const auto from = cellOf(rectangle.lower), to = cellOf(rectangle.upper);
  for (std::uint32_t y = from[1]; y <= to[1]; ++y)
    for (std::uint32_t x = from[0]; x <= to[0]; ++x) visit(std::size_t{y} * side_ + x);
}

std::span<const std::uint32_t> PlaneBuckets::at(double x, double y) const {
  const std::array<double, 2> point{x, y};
  for (int axis = 0; axis < 2; ++axis)
    if (!(point[axis] >= bounds_.lower[axis] && point[axis] <= bounds_.upper[axis])) return {};
  const auto cell = cellOf(point);
  const std::size_t index = std::size_t{cell[1]} * side_ + cell[0];
  return std::span(list_).subspan(first_[index], first_[index + 1] - first_[index]);
}

}  // namespace cairn::builder
