// SPDX-License-Identifier: GPL-3.0-or-later
#include "support_points.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <limits>

#include "balls/farthest_sample.h"
#include "balls/point_set.h"

namespace cairn::builder {

namespace {

constexpr std::size_t kMaxFacing = 64;

/// A direction, its extreme point, and the deficit of the points chosen so far against that point.
struct Direction {
  Vec3d unit;
  std::size_t extreme = 0;
  double reach = 0;
  double shortfall = std::numeric_limits<double>::infinity();
};

Direction extremeIn(const Vec3d& unit, const PointSet& points) {
  const std::size_t extreme = points.farthestAlong(unit);
  return {unit, extreme, dot(points[extreme], unit)};
}

std::vector<Vec3d> facingDirections(std::span<const FacingArea> areas) {
  std::vector<Vec3d> normals;
  for (const FacingArea& a : areas) normals.push_back(a.normal);
  return farthestPointSample(normals, kMaxFacing, 0);
}

// Over the faces of a cube, 27 degrees apart or less: the corners of a flat patch may lie anywhere around its border.
std::vector<Vec3d> evenDirections() {
  constexpr int kHalf = 2;
  std::vector<Vec3d> directions;
  for (int x = -kHalf; x <= kHalf; ++x)
    for (int y = -kHalf; y <= kHalf; ++y)
      for (int z = -kHalf; z <= kHalf; ++z)
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == kHalf)
          directions.push_back(normalized(Vec3d(x, y, z)));
  return directions;
}

}  // namespace

std::vector<Vec3d> chooseSupportPoints(std::span<const Vec3d> points, std::span<const FacingArea> areas,
                                       std::size_t most, double negligible) {
  assert(!points.empty());
  const PointSet all(points);
  std::vector<Vec3d> chosen;
  for (const std::vector<Vec3d>& units : {facingDirections(areas), evenDirections()}) {
    std::vector<Direction> directions;
    for (const Vec3d& unit : units) directions.push_back(extremeIn(unit, all));
    for (const Vec3d& point : chosen)
      for (Direction& d : directions) d.shortfall = std::min(d.shortfall, d.reach - dot(point, d.unit));
    while (chosen.size() < most) {
      const auto worst = std::max_element(directions.begin(), directions.end(),
                                          [](const auto& a, const auto& b) { return a.shortfall < b.shortfall; });
      if (worst->shortfall <= negligible) break;
      const Vec3d point = points[worst->extreme];
      chosen.push_back(point);
      for (Direction& d : directions) d.shortfall = std::min(d.shortfall, d.reach - dot(point, d.unit));
    }
  }
  return chosen;
}

}  // namespace cairn::builder
