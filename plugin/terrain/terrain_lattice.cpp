// SPDX-License-Identifier: Zlib
#include "terrain/terrain_lattice.h"

#include <utility>

namespace cairn::bullet {

namespace {

// Coordinates about the middle, so that symmetric terrain stays symmetric to the bit.
std::vector<btScalar> coordinates(std::uint32_t count, double cell) {
  std::vector<btScalar> all;
  all.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) all.push_back(btScalar((i - 0.5 * (count - 1)) * cell));
  return all;
}

}  // namespace

TerrainLattice::TerrainLattice(TerrainGrid grid)
    : grid_(std::move(grid)),
      xs_(coordinates(grid_.columns, grid_.cell)),
      ys_(coordinates(grid_.rows, grid_.cell)),
      perCell_(1 / grid_.cell) {
  boundBlocks();
}

// Bounds triangles, not points: a height that no triangle uses is no ground.
void TerrainLattice::boundBlocks() {
  blockColumns_ = (cellColumns() + kBlock - 1) / kBlock;
  blocks_.assign(static_cast<std::size_t>(blockColumns_ * ((cellRows() + kBlock - 1) / kBlock)), {});
  steepest_.assign(blocks_.size(), 0);
  for (std::int64_t row = 0; row < cellRows(); ++row)
    for (std::int64_t column = 0; column < cellColumns(); ++column) {
      const auto block = static_cast<std::size_t>(row / kBlock * blockColumns_ + column / kBlock);
      blocks_[block].add(cellBounds(column, row));
      steepest_[block] = std::max(steepest_[block], steepestOfCell(column, row));
    }
}

float TerrainLattice::steepestOfCell(std::int64_t column, std::int64_t row) const {
  double most = 0;
  for (const bool isUpper : {false, true}) {
    Corners t;
    if (!corners(column, row, isUpper, t)) return std::numeric_limits<float>::infinity();
    const Vec3d n = t.normal();
    most = std::max(most, std::hypot(n.x, n.y) / n.z);
  }
  return std::nextafter(static_cast<float>(most), std::numeric_limits<float>::infinity());
}

float TerrainLattice::steepest(const IndexRange& columns, const IndexRange& rows) const {
  float most = 0;
  for (std::int64_t j = rows.first / kBlock; j <= rows.last / kBlock; ++j)
    for (std::int64_t i = columns.first / kBlock; i <= columns.last / kBlock; ++i)
      most = std::max(most, steepest_[static_cast<std::size_t>(j * blockColumns_ + i)]);
  return most;
}

HeightBounds TerrainLattice::bounds() const {
  HeightBounds all;
  for (const HeightBounds& block : blocks_) all.add(block);
  return all;
}

std::size_t TerrainLattice::memoryBytes() const {
  return sizeof *this + grid_.heights.capacity() * sizeof(float) +
         (xs_.capacity() + ys_.capacity()) * sizeof(btScalar) + blocks_.capacity() * sizeof(HeightBounds) +
         steepest_.capacity() * sizeof(float);
}

// Guesses the index from the spacing and corrects it by the coordinates, because these are rounded.
IndexRange TerrainLattice::touching(std::span<const btScalar> points, btScalar from, btScalar to) const {
  if (!(from <= to) || to < points.front() || from > points.back()) return {};
  const auto cells = static_cast<std::int64_t>(points.size()) - 1;
  const auto guess = [&](btScalar at) {
    const double place = (double(at) - double(points.front())) * perCell_;
    return static_cast<std::int64_t>(std::clamp(place, 0.0, double(cells - 1)));
  };
  const auto at = [&](std::int64_t i) { return points[static_cast<std::size_t>(i)]; };
  IndexRange range{guess(from), guess(to)};
  while (range.first > 0 && at(range.first) >= from) --range.first;
  while (range.first + 1 < cells && at(range.first + 1) < from) ++range.first;
  while (range.last + 1 < cells && at(range.last + 1) <= to) ++range.last;
  while (range.last > 0 && at(range.last) > to) --range.last;
  return range;
}

bool TerrainLattice::corners(std::int64_t column, std::int64_t row, bool isUpper, Corners& corners) const {
  const btVector3 a = point(column, row), b = point(column + 1, row), c = point(column + 1, row + 1),
                  d = point(column, row + 1);
  const bool rises = isRising(column, row);
  if (isUpper) {
    corners.at[0] = rises ? a : b;
    corners.at[1] = c;
    corners.at[2] = d;
  } else {
    corners.at[0] = a;
    corners.at[1] = b;
    corners.at[2] = rises ? c : d;
  }
  return !std::isnan(corners.at[0].z() + corners.at[1].z() + corners.at[2].z());
}

bool TerrainLattice::cornersOver(double x, double y, Corners& corners, int& index) const {
  Over over;
  if (!locate(x, y, over)) return false;
  index = indexOf(over.column, over.row, over.isUpper);
  return this->corners(over.column, over.row, over.isUpper, corners);
}

double TerrainLattice::heightOver(double x, double y) const {
  Over over;
  if (!locate(x, y, over)) return std::numeric_limits<double>::quiet_NaN();
  const auto z = [&](std::int64_t i, std::int64_t j) { return double(height(over.column + i, over.row + j)); };
  const double u = over.u, v = over.v;
  if (isRising(over.column, over.row))
    return over.isUpper ? z(0, 0) + v * (z(0, 1) - z(0, 0)) + u * (z(1, 1) - z(0, 1))
                        : z(0, 0) + u * (z(1, 0) - z(0, 0)) + v * (z(1, 1) - z(1, 0));
  return over.isUpper ? z(1, 1) + (1 - u) * (z(0, 1) - z(1, 1)) + (1 - v) * (z(1, 0) - z(1, 1))
                      : z(0, 0) + u * (z(1, 0) - z(0, 0)) + v * (z(0, 1) - z(0, 0));
}

HeightBounds TerrainLattice::cellBounds(std::int64_t column, std::int64_t row) const {
  const float a = height(column, row), b = height(column + 1, row), c = height(column + 1, row + 1),
              d = height(column, row + 1);
  const bool rises = isRising(column, row);
  HeightBounds bounds;
  const auto add = [&](float p, float q, float r) {
    if (std::isnan(p + q + r)) return;
    for (const float z : {p, q, r}) bounds.add(z);
  };
  add(a, b, rises ? c : d);
  add(rises ? a : b, c, d);
  return bounds;
}

}  // namespace cairn::bullet
