// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL.
#include "import/flat_patch.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace cairn::builder {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Projected = CGAL::Projection_traits_3<Kernel>;
using Corner = CGAL::Triangulation_vertex_base_with_info_2<int, Projected>;  // its index
using Face = CGAL::Constrained_triangulation_face_base_2<
    Projected, CGAL::Triangulation_face_base_with_info_2<bool, Projected>>;  // whether it is outside
using Planar = CGAL::Constrained_Delaunay_triangulation_2<Projected, CGAL::Triangulation_data_structure_2<Corner, Face>,
                                                          CGAL::No_constraint_intersection_tag>;

/// Newell's normal: perpendicular to the plane in which the polygon turns left, with a length of twice its area.
Vec3d turningNormal(std::span<const Vec3d> polygon) {
  Vec3d normal;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    normal += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return normal;
}

bool isFlat(std::span<const Vec3d> polygon, const Vec3d& normal, double tolerance) {
  if (!(lengthSq(normal) > 0)) return false;
  const Vec3d up = normalized(normal);
  double low = 0, high = 0;
  for (const Vec3d& p : polygon) {
    const double height = dot(p - polygon[0], up);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high - low <= 2 * tolerance;
}

/// Marks the faces outside the constraints, from the infinite face on.
void markOutside(Planar& planar) {
  for (const auto face : planar.all_face_handles()) face->info() = false;
  std::vector<Planar::Face_handle> open{planar.infinite_face()};
  while (!open.empty()) {
    const Planar::Face_handle face = open.back();
    open.pop_back();
    if (std::exchange(face->info(), true)) continue;
    for (int i = 0; i < 3; ++i)
      if (!planar.is_constrained({face, i})) open.push_back(face->neighbor(i));
  }
}

}  // namespace

Patch flatPatch(std::span<const Vec3d> polygon, double tolerance) try {
  const Vec3d normal = turningNormal(polygon);
  if (!isFlat(polygon, normal, tolerance)) return {};
  Planar planar(Projected(Kernel::Vector_3(normal.x, normal.y, normal.z)));
  std::vector<Planar::Vertex_handle> corners;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    corners.push_back(planar.insert(Kernel::Point_3(polygon[i].x, polygon[i].y, polygon[i].z)));
    corners.back()->info() = static_cast<int>(i);
  }
  if (planar.number_of_vertices() != polygon.size() || planar.dimension() != 2) return {};
  for (std::size_t i = 0; i < corners.size(); ++i)
    planar.insert_constraint(corners[i], corners[(i + 1) % corners.size()]);
  markOutside(planar);
  Patch patch;
  for (const auto face : planar.finite_face_handles()) {
    if (face->info()) continue;
    patch.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    std::ranges::sort(patch.back());
  }
  return patch.size() + 2 == polygon.size() ? patch : Patch();
} catch (const std::exception&) {
  return {};  // sides that cross
}

}  // namespace cairn::builder
