// SPDX-License-Identifier: GPL-3.0-or-later
#include "region_normals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "balls/enclosing_ball.h"

namespace cairn::builder {

namespace {

/// Area within this angle of a direction counts for it: 8 degrees.
constexpr double kClusterCosine = 0.9902680687415704;
/// A direction with less than this share of the region's area does not represent it.
constexpr double kMinShare = 0.05;
/// Largest number of directions that are compared with each other. More are first collected in the cells of a grid on
/// the cube of directions.
constexpr int kGridCells = 24;
/// An axis rounded to float turns by less than 2^-23, and a cosine changes by at most the angle. Twice that is used.
constexpr double kConeGuard = 0x1p-22;

std::size_t cellOf(const Vec3d& n) {
  const std::array<double, 3> size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
  const int axis = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  const auto step = [&](double v) {
    return std::clamp(static_cast<int>((v / size[axis] + 1) * 0.5 * kGridCells), 0, kGridCells - 1);
  };
  const int face = 2 * axis + (n[axis] < 0 ? 1 : 0);
  return static_cast<std::size_t>((face * kGridCells + step(n[(axis + 1) % 3])) * kGridCells + step(n[(axis + 2) % 3]));
}

std::vector<FacingArea> gathered(std::span<const FacingArea> areas) {
  std::vector<Vec3d> sums(6 * kGridCells * kGridCells);
  for (const FacingArea& a : areas) sums[cellOf(a.normal)] += a.normal * a.area;
  std::vector<FacingArea> cells;
  for (const Vec3d& sum : sums)
    if (const double area = length(sum); area > 0) cells.push_back({sum / area, area});
  return cells;
}

}  // namespace

std::vector<FacingArea> facingAreas(std::span<const Piece> pieces, const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint32_t, double>> bySource;
  bySource.reserve(pieces.size());
  for (const Piece& piece : pieces) bySource.emplace_back(piece.source, areaOf(piece));
  std::sort(bySource.begin(), bySource.end());
  std::vector<FacingArea> areas;
  for (std::size_t i = 0; i < bySource.size();) {
    const std::uint32_t source = bySource[i].first;
    double area = 0;
    for (; i < bySource.size() && bySource[i].first == source; ++i) area += bySource[i].second;
    const auto [a, b, c] = mesh.corners(source);
    areas.push_back({normalized(cross(b - a, c - a)), area});
  }
  return areas;
}

std::vector<Vec3> dominantNormals(std::span<const FacingArea> areas) {
  std::vector<FacingArea> left = gathered(areas);
  double total = 0;
  for (const FacingArea& a : left) total += a.area;
  std::vector<Vec3> normals;
  while (!left.empty() && normals.size() < kMaxFaceNormals) {
    Vec3d best;
    for (const FacingArea& center : left) {
      Vec3d sum;
      for (const FacingArea& a : left)
        if (dot(a.normal, center.normal) >= kClusterCosine) sum += a.normal * a.area;
      if (lengthSq(sum) > lengthSq(best)) best = sum;
    }
    if (length(best) < kMinShare * total) break;
    const Vec3d normal = normalized(best);
    normals.emplace_back(normal);
    std::erase_if(left, [&](const FacingArea& a) { return dot(a.normal, normal) >= kClusterCosine; });
  }
  return normals;
}

NormalCone normalConeOf(std::span<const FacingArea> areas) {
  std::vector<Vec3d> normals;
  for (const FacingArea& a : areas) normals.push_back(a.normal);
  // A cone narrower than a half space is cut from the unit sphere by the smallest ball around its directions.
  const EnclosingBall ball = smallestEnclosingBall(normals);
  if (ball.radius >= 1 || lengthSq(ball.center) == 0) return {};
  const Vec3d axis = normalized(ball.center);
  double cosine = 1;
  for (const Vec3d& n : normals) cosine = std::min(cosine, dot(n, axis));
  if (cosine <= 0) return {};
  const auto rounded = static_cast<float>(std::max(-1.0, cosine - kConeGuard));
  return {Vec3(axis), std::nextafter(rounded, -1.0F)};
}

}  // namespace cairn::builder
