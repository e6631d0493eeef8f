// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL.
#include "import/triangulate.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <exception>
#include <iterator>
#include <span>
#include <vector>

#include "import/flat_patch.h"
#include "import/weld.h"

namespace cairn::builder {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using TrianglePair = std::array<std::array<Vec3d, 3>, 2>;

/// Cut from one corner to the one opposite.
TrianglePair cutFrom(std::size_t corner, std::span<const Vec3d> p) {
  const auto at = [&](std::size_t i) { return p[(corner + i) % 4]; };
  return {{{at(0), at(1), at(2)}, {at(0), at(2), at(3)}}};
}

Vec3d normalOf(const std::array<Vec3d, 3>& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

void appendQuadrangle(std::span<const Vec3d> p, TriangleSoup& soup) {
  TrianglePair pair = cutFrom(0, p);
  const bool folds = dot(normalOf(pair[0]), normalOf(pair[1])) < 0;
  if (folds || isDegenerate(pair[0]) || isDegenerate(pair[1])) pair = cutFrom(1, p);
  soup.insert(soup.end(), pair.begin(), pair.end());
}

double diagonalOf(std::span<const Vec3d> points) {
  Vec3d lower = points[0], upper = points[0];
  for (const Vec3d& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], p[axis]);
      upper[axis] = std::max(upper[axis], p[axis]);
    }
  }
  return distance(lower, upper);
}

/// The surface of least area over all triangulations, cubic in the corners.
Patch leastPatchOf(std::span<const Vec3d> polygon) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3d& p : polygon) points.emplace_back(p.x, p.y, p.z);
  std::vector<CGAL::Triple<int, int, int>> found;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
      points, std::back_inserter(found),
      CGAL::parameters::use_2d_constrained_delaunay_triangulation(false).use_delaunay_triangulation(false));
  Patch patch;
  for (const auto& t : found) patch.push_back({t.first, t.second, t.third});
  return patch;
}

/// Empty when CGAL finds none.
Patch patchOf(std::span<const Vec3d> polygon) try {
  constexpr std::size_t kMaxCubicCorners = 100;  // a hundredth of a second
  constexpr double kFlat = 0.1;                  // of its box's diagonal
  if (Patch flat = flatPatch(polygon, kFlat * diagonalOf(polygon)); !flat.empty()) return flat;
  if (polygon.size() > kMaxCubicCorners) return {};
  Patch least = leastPatchOf(polygon);
  return least.size() + 2 == polygon.size() ? least : Patch();
} catch (const std::exception&) {
  return {};
}

void appendPolygon(std::span<const Vec3d> p, TriangleSoup& soup) {
  Patch patch = patchOf(p);
  if (patch.empty()) {
    for (int i = 2; i < static_cast<int>(p.size()); ++i) patch.push_back({0, i - 1, i});
  }
  const auto corner = [&](int place) { return p[static_cast<std::size_t>(place)]; };
  for (const auto& [a, b, c] : patch) soup.push_back({corner(a), corner(b), corner(c)});
}

/// Drops corners at the position of the one before. A polygon with fewer than three positions keeps three corners,
/// without area.
void dropRepeated(std::vector<Vec3d>& polygon) {
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
  if (polygon.size() < 3) polygon.resize(3, Vec3d(polygon.front()));
}

}  // namespace

TriangleSoup triangulated(const PolygonSoup& polygons) {
  TriangleSoup soup;
  soup.reserve(polygons.corners.size() - 2 * polygons.ends.size());
  std::vector<Vec3d> polygon;
  std::size_t corner = 0;
  for (const std::size_t end : polygons.ends) {
    polygon.clear();
    for (; corner < end; ++corner) polygon.push_back(polygons.points[polygons.corners[corner]]);
    if (polygon.size() > 3) dropRepeated(polygon);
    if (polygon.size() == 3)
      soup.push_back({polygon[0], polygon[1], polygon[2]});
    else if (polygon.size() == 4)
      appendQuadrangle(polygon, soup);
    else
      appendPolygon(polygon, soup);
  }
  return soup;
}

}  // namespace cairn::builder
