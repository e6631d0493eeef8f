// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/rockfall/slope.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "scenes/figures/random.h"

namespace cairn::scenes {
namespace {

constexpr double kCell = 0.5;  // metres between grid points
constexpr std::uint32_t kColumns = 141, kRows = 45;
constexpr double kRoughness = 0.06;  // greatest displacement of a grid point, metres
constexpr double kBankHeight = 8;    // metres over two cells: about 83 degrees
constexpr double kBasinEnd = 66;

double xOf(std::uint32_t column) {
  return kCell * (column - 4.0);
}
double yOf(std::uint32_t row) {
  return kCell * (row - (kRows - 1) / 2.0);
}

/// A range of cells or grid points along one axis.
struct Range {
  std::uint32_t first, last;
};

/// Grid lines, of `count`, from `low` to `high` cells; at least the nearest.
Range gridLines(double low, double high, std::uint32_t count) {
  const auto clamped = [&](double at) { return static_cast<std::uint32_t>(std::clamp(at, 0.0, count - 1.0)); };
  return {clamped(std::ceil(low)), clamped(std::floor(high))};
}

double distanceToSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab = b - a;
  return distance(p, a + ab * std::clamp(dot(p - a, ab) / lengthSq(ab), 0.0, 1.0));
}

double distanceToTriangle(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  const Vec3d normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
  bool isAbove = true;
  for (int i = 0; i < 3; ++i) isAbove = isAbove && dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) >= 0;
  if (isAbove) return std::abs(dot(p - t[0], normal));
  return std::min(
      {distanceToSegment(p, t[0], t[1]), distanceToSegment(p, t[1], t[2]), distanceToSegment(p, t[2], t[0])});
}

/// The profile down the slope: corners of risers and benches, straight between.
double profileHeight(double x) {
  static constexpr std::array<std::array<double, 2>, 12> kCorners{{{0, Slope::kShelfHeight},
                                                                   {Slope::kShelfLength, 23},
                                                                   {13, 18.5},
                                                                   {15.5, 18},
                                                                   {20, 13},
                                                                   {22, 12.8},
                                                                   {29, 7.5},
                                                                   {32, 7.2},
                                                                   {36, 3.5},
                                                                   {38, 3.3},
                                                                   {44, 0},
                                                                   {70, 0}}};
  if (x <= kCorners.front()[0]) return kCorners.front()[1];
  for (std::size_t i = 1; i < kCorners.size(); ++i) {
    const auto [x0, z0] = kCorners[i - 1];
    const auto [x1, z1] = kCorners[i];
    if (x <= x1) return z0 + (z1 - z0) * (x - x0) / (x1 - x0);
  }
  return kCorners.back()[1];
}

/// Height of the banks at a point beyond the usable width.
double bankHeight(double x, double y) {
  const double outside = std::max({std::abs(y) - Slope::kHalfWidth, -x, x - kBasinEnd, 0.0});
  return kBankHeight * std::min(outside / (2 * kCell), 1.0);
}

}  // namespace

Slope::Slope(std::uint64_t seed) {
  Random random(seed);
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const double x = xOf(column), y = yOf(row);
      heights_.push_back(profileHeight(x) + bankHeight(x, y) + kRoughness * random.uniform(-1, 1));
      for (const double c : {x, y, heights_.back()}) coordinates_.push_back(static_cast<btScalar>(c));
    }
  }
  const auto point = [](std::uint32_t column, std::uint32_t row) { return static_cast<int>(row * kColumns + column); };
  for (std::uint32_t row = 0; row + 1 < kRows; ++row) {
    for (std::uint32_t column = 0; column + 1 < kColumns; ++column) {
      const int a = point(column, row), b = point(column + 1, row), c = point(column + 1, row + 1),
                d = point(column, row + 1);
      indices_.insert(indices_.end(), {a, b, c, a, c, d});
    }
  }
  mesh_ = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(indices_.size() / 3), indices_.data(), static_cast<int>(3 * sizeof(int)),
      static_cast<int>(heights_.size()), coordinates_.data(), static_cast<int>(3 * sizeof(btScalar)));
  shape_ = std::make_unique<btBvhTriangleMeshShape>(mesh_.get(), true);
}

bool Slope::covers(double x, double y) const {
  return x >= xOf(0) && x < xOf(kColumns - 1) && y >= yOf(0) && y < yOf(kRows - 1);
}

double Slope::gridHeight(std::uint32_t column, std::uint32_t row) const {
  return heights_[row * kColumns + column];
}

Vec3d Slope::corner(std::uint32_t column, std::uint32_t row) const {
  return {xOf(column), yOf(row), gridHeight(column, row)};
}

double Slope::signedDistance(const Vec3d& p) const {
  const double height = p.z - heightAt(p.x, p.y);
  // No point can be nearer if its horizontal distance exceeds the vertical distance.
  const double reach = std::abs(height) / kCell, column = (p.x - xOf(0)) / kCell, row = (p.y - yOf(0)) / kCell;
  const Range columns = gridLines(std::floor(column - reach), column + reach, kColumns - 1),
              rows = gridLines(std::floor(row - reach), row + reach, kRows - 1);
  double nearest = std::abs(height);
  for (std::uint32_t j = rows.first; j <= rows.last; ++j)
    for (std::uint32_t i = columns.first; i <= columns.last; ++i) {
      const Vec3d a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
      nearest = std::min({nearest, distanceToTriangle(p, {a, b, c}), distanceToTriangle(p, {a, c, d})});
    }
  return height < 0 ? -nearest : nearest;
}

std::vector<Vec3d> Slope::cornersIn(const Vec3d& lower, const Vec3d& upper) const {
  const Range columns = gridLines((lower.x - xOf(0)) / kCell, (upper.x - xOf(0)) / kCell, kColumns),
              rows = gridLines((lower.y - yOf(0)) / kCell, (upper.y - yOf(0)) / kCell, kRows);
  std::vector<Vec3d> corners;
  for (std::uint32_t j = rows.first; j <= rows.last; ++j)
    for (std::uint32_t i = columns.first; i <= columns.last; ++i)
      if (const double z = gridHeight(i, j); z >= lower.z && z <= upper.z) corners.push_back(corner(i, j));
  return corners;
}

double Slope::heightAt(double x, double y) const {
  assert(covers(x, y));
  const double column = (x - xOf(0)) / kCell, row = (y - yOf(0)) / kCell;
  const auto i = static_cast<std::uint32_t>(column), j = static_cast<std::uint32_t>(row);
  const double u = column - i, v = row - j;
  const double origin = gridHeight(i, j), opposite = gridHeight(i + 1, j + 1);
  // The two triangles of a cell share its diagonal u = v.
  if (u >= v) return origin + u * (gridHeight(i + 1, j) - origin) + v * (opposite - gridHeight(i + 1, j));
  return origin + v * (gridHeight(i, j + 1) - origin) + u * (opposite - gridHeight(i, j + 1));
}

}  // namespace cairn::scenes
