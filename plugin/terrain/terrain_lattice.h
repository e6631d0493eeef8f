// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cairn/bullet/terrain_shape.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

/// Cells or blocks from `first` to `last`, both included; empty where first > last.
struct IndexRange {
  std::int64_t first = 0, last = -1;

  bool isEmpty() const { return first > last; }
  IndexRange cutTo(const IndexRange& other) const { return {std::max(first, other.first), std::min(last, other.last)}; }
};

/// The lowest and the highest height; empty without ground.
struct HeightBounds {
  float lower = std::numeric_limits<float>::infinity(), upper = -std::numeric_limits<float>::infinity();

  void add(float height) {
    lower = std::min(lower, height);  // false for NaN, which leaves the bounds as they are
    upper = std::max(upper, height);
  }
  void add(const HeightBounds& other) {
    lower = std::min(lower, other.lower);
    upper = std::max(upper, other.upper);
  }
  bool touches(btScalar from, btScalar to) const { return btScalar(lower) <= to && btScalar(upper) >= from; }
};

/// A grid's points in the shape's frame, its triangles, and the height bounds of its blocks of cells.
///
///     TerrainLattice::Corners triangle;
///     if (lattice.cornersOver(x, y, triangle)) use(triangle.heightAt(x, y));
class TerrainLattice {
 public:
  /// Cells along a block's side. A rock that covers some cells meets one to four blocks. The number of blocks is 1/256
  /// of the number of cells.
  static constexpr std::int64_t kBlock = 16;

  struct Corners {
    btVector3 at[3];

    /// Upwards, not normalised.
    Vec3d normal() const { return cross(toVec3d(at[1]) - toVec3d(at[0]), toVec3d(at[2]) - toVec3d(at[0])); }
    /// Height of the triangle's plane over (x, y).
    double heightAt(double x, double y) const {
      const Vec3d n = normal();
      return double(at[0].z()) - (n.x * (x - double(at[0].x())) + n.y * (y - double(at[0].y()))) / n.z;
    }
  };

  /// Precondition: a grid that `TerrainShape::create` accepts.
  explicit TerrainLattice(TerrainGrid grid);

  const TerrainGrid& grid() const { return grid_; }
  std::int64_t cellColumns() const { return static_cast<std::int64_t>(xs_.size()) - 1; }
  std::int64_t cellRows() const { return static_cast<std::int64_t>(ys_.size()) - 1; }
  /// Coordinates of the points' columns and rows.
  std::span<const btScalar> xs() const { return xs_; }
  std::span<const btScalar> ys() const { return ys_; }
  /// The bounds of all triangles.
  HeightBounds bounds() const;
  std::size_t memoryBytes() const;

  /// Columns of cells that share a coordinate with [from, to]; rows likewise.
  IndexRange columnsTouching(btScalar from, btScalar to) const { return touching(xs_, from, to); }
  IndexRange rowsTouching(btScalar from, btScalar to) const { return touching(ys_, from, to); }
  /// Precondition: a block of this lattice.
  const HeightBounds& blockBounds(std::int64_t blockColumn, std::int64_t blockRow) const {
    return blocks_[static_cast<std::size_t>(blockRow * blockColumns_ + blockColumn)];
  }
  /// The bounds of the cell's triangles. Precondition: a cell of this lattice.
  HeightBounds cellBounds(std::int64_t column, std::int64_t row) const;
  /// The corners of one of a cell's triangles, counter-clockwise from above. Returns false where it is missing.
  bool corners(std::int64_t column, std::int64_t row, bool isUpper, Corners& corners) const;
  /// Height of the triangle over (x, y); NaN where there is none. This is the fastest query.
  double heightOver(double x, double y) const;
  /// The greatest slope, metres a metre, in the blocks that hold these cells. It is infinite where ground is missing in
  /// them. Precondition: cells of this lattice.
  float steepest(const IndexRange& columns, const IndexRange& rows) const;
  /// A point over the grid: its cell, and where it is in the cell.
  struct Over {
    std::int64_t column, row;
    double u, v;  ///< from 0 to 1 across the cell
    bool isUpper;
  };
  /// The cell over (x, y), whether or not it has a triangle; on a border the cell at greater x and y. Returns false
  /// outside the grid.
  bool locate(double x, double y, Over& over) const;
  /// The triangle over (x, y). Returns false where there is none.
  bool cornersOver(double x, double y, Corners& corners, int& index) const;
  bool cornersOver(double x, double y, Corners& corners) const {
    int index = 0;
    return cornersOver(x, y, corners, index);
  }
  /// Whether the cell's diagonal rises from the lower left to the upper right, seen from above.
  bool isRising(std::int64_t column, std::int64_t row) const {
    if (grid_.diagonals != TerrainDiagonals::alternating) return grid_.diagonals == TerrainDiagonals::rising;
    return (column + row) % 2 == 0;
  }
  /// The index of one of a cell's triangles in contacts and hits, as in `TerrainTriangle`.
  int indexOf(std::int64_t column, std::int64_t row, bool isUpper) const {
    return static_cast<int>(2 * (row * cellColumns() + column) + (isUpper ? 1 : 0));
  }

  /// Calls `visit(column, row)` for the cells below or above the box whose blocks have heights in it. No allocation.
  template <class Visit>
  void forEachCell(const btVector3& lower, const btVector3& upper, const Visit& visit) const;

 private:
  float height(std::int64_t column, std::int64_t row) const {
    return grid_.heights[static_cast<std::size_t>(row * (cellColumns() + 1) + column)];
  }
  btVector3 point(std::int64_t column, std::int64_t row) const {
    return {xs_[static_cast<std::size_t>(column)], ys_[static_cast<std::size_t>(row)], btScalar(height(column, row))};
  }
  IndexRange touching(std::span<const btScalar> points, btScalar from, btScalar to) const;
  /// The last cell that begins at `at` or before; -1 outside the grid.
  std::int64_t cellAt(std::span<const btScalar> points, double at) const;
  float steepestOfCell(std::int64_t column, std::int64_t row) const;
  void boundBlocks();

  TerrainGrid grid_;
  std::vector<btScalar> xs_, ys_;
  std::int64_t blockColumns_ = 0;
  double perCell_ = 1;
  std::vector<HeightBounds> blocks_;  // of their triangles, row by row
  std::vector<float> steepest_;       // greatest slope in each block
};

inline std::int64_t TerrainLattice::cellAt(std::span<const btScalar> points, double at) const {
  const auto point = [&](std::int64_t i) { return double(points[static_cast<std::size_t>(i)]); };
  const auto cells = static_cast<std::int64_t>(points.size()) - 1;
  if (!(at >= point(0) && at <= point(cells))) return -1;
  std::int64_t cell = std::min(static_cast<std::int64_t>((at - point(0)) * perCell_), cells - 1);
  while (cell > 0 && point(cell) > at) --cell;
  while (cell + 1 < cells && point(cell + 1) <= at) ++cell;
  return cell;
}

inline bool TerrainLattice::locate(double x, double y, Over& over) const {
  over.column = cellAt(xs_, x);
  over.row = cellAt(ys_, y);
  if (over.column < 0 || over.row < 0) return false;
  const auto within = [](std::span<const btScalar> points, std::int64_t i, double at) {
    const double from = double(points[static_cast<std::size_t>(i)]);
    return (at - from) / (double(points[static_cast<std::size_t>(i + 1)]) - from);
  };
  over.u = within(xs_, over.column, x);
  over.v = within(ys_, over.row, y);
  over.isUpper = isRising(over.column, over.row) ? over.v > over.u : over.u + over.v > 1;
  return true;
}

template <class Visit>
void TerrainLattice::forEachCell(const btVector3& lower, const btVector3& upper, const Visit& visit) const {
  const IndexRange columns = columnsTouching(lower.x(), upper.x()), rows = rowsTouching(lower.y(), upper.y());
  if (columns.isEmpty() || rows.isEmpty()) return;
  for (std::int64_t j = rows.first / kBlock; j <= rows.last / kBlock; ++j)
    for (std::int64_t i = columns.first / kBlock; i <= columns.last / kBlock; ++i) {
      if (!blockBounds(i, j).touches(lower.z(), upper.z())) continue;
      const IndexRange inRows = rows.cutTo({j * kBlock, (j + 1) * kBlock - 1});
      const IndexRange inColumns = columns.cutTo({i * kBlock, (i + 1) * kBlock - 1});
      for (std::int64_t row = inRows.first; row <= inRows.last; ++row)
        for (std::int64_t column = inColumns.first; column <= inColumns.last; ++column) visit(column, row);
    }
}

}  // namespace cairn::bullet
