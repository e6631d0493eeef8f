// SPDX-License-Identifier: GPL-3.0-or-later
#include "oriented_grid.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <utility>

namespace cairn::builder {

namespace {

/// The ball around a cell reaches this many cells at most beyond it: (sqrt(3) - 1) / 2 < 1.
constexpr int kReach = 1;
/// Widens the balls, so that a point on a cell's corner is in that cell's ball whatever rounding does.
constexpr double kSlack = 1 + 1e-12;

/// Room for rounding around the points, in parts of the first cell.
constexpr double kMargin = 1e-7;

/// A cell as one number, for fast sorting; ordered by x, then y, then z.
class CellKey {
 public:
  CellKey(std::int64_t x, std::int64_t y, std::int64_t z)
      : key_(((x + kOffset) << (2 * kBits)) | ((y + kOffset) << kBits) | (z + kOffset)) {}
  Vec3d cell() const {
    constexpr std::int64_t kMask = (std::int64_t{1} << kBits) - 1;
    return Vec3d(static_cast<double>(key_ >> (2 * kBits)), static_cast<double>((key_ >> kBits) & kMask),
                 static_cast<double>(key_ & kMask)) -
           Vec3d(kOffset, kOffset, kOffset);
  }
  friend auto operator<=>(const CellKey&, const CellKey&) = default;

 private:
  /// Cells shrink to a hundredth of the points' box at the smallest and move by a few boxes: far from 2^19.
  static constexpr int kBits = 20;
  static constexpr std::int64_t kOffset = std::int64_t{1} << (kBits - 1);
  std::int64_t key_;
};

using Holding = std::pair<CellKey, std::uint32_t>;

/// Which cells' balls hold a point, as one list of (cell, point), cells first.
std::vector<Holding> holdings(const OrientedGrid& grid, std::span<const Vec3d> points) {
  const double radiusSq = 0.75 * kSlack;  // in cells
  std::vector<Holding> list;
  list.reserve(points.size() * 3);
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    std::array<double, 3> inCell{};  // from the middle of its home
    std::array<std::int64_t, 3> home{};
    for (int axis = 0; axis < 3; ++axis) {
      const double at = dot(points[p] - grid.corner, grid.axes[axis]) / grid.edge;
      home[axis] = static_cast<std::int64_t>(std::floor(at));
      inCell[axis] = at - std::floor(at) - 0.5;
    }
    for (int x = -kReach; x <= kReach; ++x)
      for (int y = -kReach; y <= kReach; ++y)
        for (int z = -kReach; z <= kReach; ++z) {
          const Vec3d offset(inCell[0] - x, inCell[1] - y, inCell[2] - z);
          if (lengthSq(offset) <= radiusSq) list.emplace_back(CellKey(home[0] + x, home[1] + y, home[2] + z), p);
        }
  }
  std::sort(list.begin(), list.end());
  return list;
}

Vec3d rotated(const Vec3d& v, const Vec3d& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
}

}  // namespace

OrientedGrid principalGrid(std::span<const Vec3d> points) {
  assert(!points.empty());
  Vec3d mean;
  for (const Vec3d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vec3d& p : points) {
    const Eigen::Vector3d d(p.x - mean.x, p.y - mean.y, p.z - mean.z);
    covariance += d * d.transpose();
  }
  const Eigen::Matrix3d vectors = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  OrientedGrid grid;
  for (int i = 0; i < 2; ++i) grid.axes[i] = normalized(Vec3d(vectors(0, i), vectors(1, i), vectors(2, i)));
  grid.axes[2] = cross(grid.axes[0], grid.axes[1]);
  grid.edge = 0;
  grid.corner = {};
  for (const Vec3d& axis : grid.axes) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3d& p : points) {
      low = std::min(low, dot(p, axis));
      high = std::max(high, dot(p, axis));
    }
    grid.corner += axis * low;
    grid.edge = std::max(grid.edge, high - low);
  }
  if (!(grid.edge > 0)) grid.edge = 1;
  for (const Vec3d& axis : grid.axes) grid.corner -= axis * (kMargin * grid.edge);
  grid.edge *= 1 + 2 * kMargin;
  return grid;
}

OrientedGrid moved(const OrientedGrid& grid, const std::array<double, 6>& change, const Vec3d& pivot) {
  OrientedGrid result = grid;
  for (int i = 0; i < 3; ++i) result.corner += grid.axes[i] * (change[i] * grid.edge);
  for (int i = 0; i < 3; ++i) {
    const Vec3d axis = grid.axes[i];
    for (Vec3d& a : result.axes) a = rotated(a, axis, change[i + 3]);
    result.corner = pivot + rotated(result.corner - pivot, axis, change[i + 3]);
  }
  return result;
}

namespace {

/// Cells with a point in their balls, and what these hold, both ways.
struct Incidence {
  explicit Incidence(const std::vector<Holding>& list, std::size_t points) : begin(points + 1, 0), cells(list.size()) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i == 0 || list[i].first != list[i - 1].first) first.push_back(i);
      ++begin[list[i].second + 1];
    }
    first.push_back(list.size());
    for (std::size_t p = 0; p < points; ++p) begin[p + 1] += begin[p];
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t c = 0; c + 1 < first.size(); ++c)
      for (std::size_t i = first[c]; i < first[c + 1]; ++i) cells[next[list[i].second]++] = c;
  }

  std::vector<std::size_t> first;    // of each cell in the list, and the list's end
  std::vector<std::size_t> begin;    // of each point in `cells`, and its end
  std::vector<std::uint32_t> cells;  // by point
};

}  // namespace

GridCover coverByGrid(const OrientedGrid& grid, std::span<const Vec3d> points) {
  const std::vector<Holding> list = holdings(grid, points);
  const Incidence incidence(list, points.size());
  std::vector<std::size_t> left;  // uncovered points in each cell's ball
  for (std::size_t c = 0; c + 1 < incidence.first.size(); ++c)
    left.push_back(incidence.first[c + 1] - incidence.first[c]);
  std::vector<bool> covered(points.size(), false);
  GridCover cover;
  for (std::size_t uncovered = points.size(); uncovered > 0;) {
    const auto best = static_cast<std::size_t>(std::max_element(left.begin(), left.end()) - left.begin());
    const std::size_t count = left[best];
    assert(count > 0);
    cover.metric += static_cast<double>(count) * static_cast<double>(count);
    uncovered -= count;
    const Vec3d cell = list[incidence.first[best]].first.cell();
    Vec3d center = grid.corner;
    for (int axis = 0; axis < 3; ++axis) center += grid.axes[axis] * ((cell[axis] + 0.5) * grid.edge);
    cover.centers.push_back(center);
    for (std::size_t i = incidence.first[best]; i < incidence.first[best + 1]; ++i) {
      const std::uint32_t p = list[i].second;
      if (covered[p]) continue;
      covered[p] = true;
      for (std::size_t k = incidence.begin[p]; k < incidence.begin[p + 1]; ++k) --left[incidence.cells[k]];
    }
  }
  return cover;
}

}  // namespace cairn::builder
