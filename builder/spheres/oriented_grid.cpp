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

/// The ball around a cell extends at most this many cells beyond it: (sqrt(3) - 1) / 2 < 1.
constexpr int kReach = 1;
/// Widens the balls, so that a point on a cell's corner lies in that cell's ball despite rounding.
constexpr double kSlack = 1 + 1e-12;

/// Margin for rounding around the points, as a fraction of the first cell.
constexpr double kMargin = 1e-7;

/// The positions of the points in the grid, and the cells whose balls hold each point. Candidate cells form a block,
/// numbered with x slowest.
class Holdings {
 public:
  Holdings(const OrientedGrid& grid, std::span<const Vec3d> points) : places_(points.size()) {
    for (std::size_t p = 0; p < points.size(); ++p) places_[p] = placeOf(grid, points[p]);
    for (int axis = 0; axis < 3; ++axis) {
      std::int64_t high = places_[0].home[axis];
      low_[axis] = high;
      for (const Place& place : places_) {
        low_[axis] = std::min(low_[axis], place.home[axis]);
        high = std::max(high, place.home[axis]);
      }
      low_[axis] -= kReach;
      size_[axis] = static_cast<std::size_t>(high + kReach - low_[axis]) + 1;
    }
    begin_.reserve(points.size() + 1);
    cells_.reserve(points.size() * 4);
    for (const Place& place : places_) {
      begin_.push_back(cells_.size());
      addCellsOf(place);
    }
    begin_.push_back(cells_.size());
  }

  std::size_t cellCount() const { return size_[0] * size_[1] * size_[2]; }
  /// By point: the cells whose balls hold it, ascending.
  std::span<std::size_t> cellsOf(std::size_t point) {
    return std::span(cells_).subspan(begin_[point], begin_[point + 1] - begin_[point]);
  }
  /// The cell's corner, in cells.
  Vec3d cornerOf(std::size_t cell) const {
    return {static_cast<double>(low_[0]) + static_cast<double>(cell / (size_[1] * size_[2])),
            static_cast<double>(low_[1]) + static_cast<double>(cell / size_[2] % size_[1]),
            static_cast<double>(low_[2]) + static_cast<double>(cell % size_[2])};
  }

 private:
  struct Place {
    std::array<std::int64_t, 3> home{};
    std::array<double, 3> inCell{};  // from the middle of its home
  };

  static Place placeOf(const OrientedGrid& grid, const Vec3d& point) {
    Place place;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = dot(point - grid.corner, grid.axes[axis]) / grid.edge;
      auto floor = static_cast<std::int64_t>(at);  // towards zero
      floor -= at < static_cast<double>(floor) ? 1 : 0;
      place.home[axis] = floor;
      place.inCell[axis] = at - static_cast<double>(floor) - 0.5;
    }
    return place;
  }

  void addCellsOf(const Place& place) {
    constexpr double kRadiusSq = 0.75 * kSlack;  // in cells
    constexpr int kSide = 2 * kReach + 1;
    std::array<std::array<double, kSide>, 3> square{};
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < kSide; ++i) {
        const double offset = place.inCell[axis] - (i - kReach);
        square[axis][i] = offset * offset;
      }
    const auto at = [&](int axis) { return static_cast<std::size_t>(place.home[axis] - low_[axis] - kReach); };
    const std::size_t first = (at(0) * size_[1] + at(1)) * size_[2] + at(2);
    for (std::size_t x = 0; x < kSide; ++x)
      for (std::size_t y = 0; y < kSide; ++y) {
        const double beside = square[0][x] + square[1][y];
        if (beside > kRadiusSq) continue;
        for (std::size_t z = 0; z < kSide; ++z)
          if (beside + square[2][z] <= kRadiusSq) cells_.push_back(first + (x * size_[1] + y) * size_[2] + z);
      }
  }

  std::vector<Place> places_;
  std::array<std::int64_t, 3> low_{};
  std::array<std::size_t, 3> size_{};
  std::vector<std::size_t> begin_, cells_;
};

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

/// A table of all cells of a block is used up to this many cells for each point.
constexpr std::size_t kCellsAPoint = 256;

/// Cells with a point in their balls, renumbered in order, and the points of their balls.
class Cells {
 public:
  /// Renumbers the cells of `holdings`.
  Cells(Holdings& holdings, std::size_t points) {
    if (holdings.cellCount() <= kCellsAPoint * points)
      numberByTable(holdings, points);
    else
      numberBySearch(holdings, points);
    points_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t p = 0; p < points; ++p)
      for (const std::size_t cell : holdings.cellsOf(p)) points_[next[cell]++] = p;
  }

  std::size_t size() const { return cells_.size(); }
  std::size_t original(std::size_t cell) const { return cells_[cell]; }
  std::span<const std::uint32_t> pointsOf(std::size_t cell) const {
    return std::span(points_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
  }

 private:
  void numberByTable(Holdings& holdings, std::size_t points) {
    std::vector<std::uint32_t> numbers(holdings.cellCount(), 0);
    for (std::size_t p = 0; p < points; ++p)
      for (const std::size_t cell : holdings.cellsOf(p)) ++numbers[cell];
    first_.push_back(0);
    for (std::size_t cell = 0; cell < numbers.size(); ++cell) {
      if (numbers[cell] == 0) continue;
      first_.push_back(first_.back() + numbers[cell]);
      numbers[cell] = static_cast<std::uint32_t>(cells_.size());
      cells_.push_back(cell);
    }
    for (std::size_t p = 0; p < points; ++p)
      for (std::size_t& cell : holdings.cellsOf(p)) cell = numbers[cell];
  }

  // The points of a rod lie in few of the very many cells of its block.
  void numberBySearch(Holdings& holdings, std::size_t points) {
    for (std::size_t p = 0; p < points; ++p)
      cells_.insert(cells_.end(), holdings.cellsOf(p).begin(), holdings.cellsOf(p).end());
    std::ranges::sort(cells_);
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    first_.assign(cells_.size() + 1, 0);
    for (std::size_t p = 0; p < points; ++p)
      for (std::size_t& cell : holdings.cellsOf(p)) {
        cell = static_cast<std::size_t>(std::ranges::lower_bound(cells_, cell) - cells_.begin());
        ++first_[cell + 1];
      }
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) first_[cell + 1] += first_[cell];
  }

  std::vector<std::size_t> cells_;
  std::vector<std::uint32_t> first_, points_;
};

/// The cells, ordered by the number of uncovered points in their balls, largest first; lower numbers first on a tie.
class Ranking {
 public:
  explicit Ranking(std::vector<std::uint32_t> left) : left_(std::move(left)) {
    for (std::uint32_t cell = 0; cell < left_.size(); ++cell) heap_.push_back(entryOf(cell));
    std::make_heap(heap_.begin(), heap_.end());
  }

  std::uint32_t left(std::size_t cell) const { return left_[cell]; }
  void lose(std::size_t cell) { --left_[cell]; }

  /// Counts only fall, so the first entry with a current count is the best.
  std::uint32_t best() {
    while (true) {
      const std::uint32_t cell = ~static_cast<std::uint32_t>(heap_.front());
      if (heap_.front() == entryOf(cell)) return cell;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.back() = entryOf(cell);
      std::push_heap(heap_.begin(), heap_.end());
    }
  }

 private:
  std::uint64_t entryOf(std::uint32_t cell) const {
    return (std::uint64_t{left_[cell]} << 32) | static_cast<std::uint32_t>(~cell);
  }

  std::vector<std::uint32_t> left_;
  std::vector<std::uint64_t> heap_;
};

}  // namespace

GridCover coverByGrid(const OrientedGrid& grid, std::span<const Vec3d> points) {
  Holdings holdings(grid, points);
  const Cells cells(holdings, points.size());
  std::vector<std::uint32_t> counts(cells.size());
  for (std::size_t c = 0; c < counts.size(); ++c) counts[c] = static_cast<std::uint32_t>(cells.pointsOf(c).size());
  Ranking ranking(std::move(counts));
  std::vector<bool> covered(points.size(), false);
  GridCover cover;
  for (std::size_t uncovered = points.size(); uncovered > 0;) {
    const std::uint32_t best = ranking.best();
    const std::size_t count = ranking.left(best);
    assert(count > 0);
    cover.metric += static_cast<double>(count) * static_cast<double>(count);
    uncovered -= count;
    const Vec3d cell = holdings.cornerOf(cells.original(best));
    Vec3d center = grid.corner;
    for (int axis = 0; axis < 3; ++axis) center += grid.axes[axis] * ((cell[axis] + 0.5) * grid.edge);
    cover.centers.push_back(center);
    for (const std::uint32_t p : cells.pointsOf(best)) {
      if (covered[p]) continue;
      covered[p] = true;
      for (const std::size_t held : holdings.cellsOf(p)) ranking.lose(held);
    }
  }
  return cover;
}

}  // namespace cairn::builder
