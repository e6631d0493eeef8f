// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cairn::builder {

/// An axis-aligned rectangle of the xy plane, edges included.
struct Rectangle {
  std::array<double, 2> lower{}, upper{};
};

/// Finds the rectangles that may hold a point of the plane. It is a regular grid with a list per cell and about one
/// cell for each rectangle. There are fewer cells when the lists would take more than `kMaxPerRectangle` entries per
/// rectangle. A query costs O(1) for rectangles of similar size that overlap little. Memory is linear for any input.
class PlaneBuckets {
 public:
  static constexpr std::size_t kMaxPerRectangle = 32;

  /// O(n).
  explicit PlaneBuckets(std::span<const Rectangle> rectangles);

  /// Returns ascending indices of rectangles; all rectangles that hold (x, y) are among them. Empty outside `bounds()`.
  std::span<const std::uint32_t> at(double x, double y) const;
  /// Bounds of all rectangles; lower = upper = 0 without any.
  const Rectangle& bounds() const { return bounds_; }
  /// Number of entries in all lists.
  std::size_t entries() const { return list_.size(); }

 private:
  std::size_t entriesFor(std::span<const Rectangle> rectangles) const;
  std::array<std::uint32_t, 2> cellOf(const std::array<double, 2>& point) const;
  template <class Visit>
  void forCells(const Rectangle& rectangle, const Visit& visit) const;

  Rectangle bounds_;
  std::uint32_t side_ = 1;                   // cells along each axis
  std::vector<std::uint32_t> first_, list_;  // indices of cell i: list_[first_[i]] to list_[first_[i + 1]]
};

}  // namespace cairn::builder
