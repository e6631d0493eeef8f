// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL.
#include "fracture/cap.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <exception>
#include <map>
#include <utility>

#include "fracture/plane_axes.h"

namespace cairn::builder {
namespace {

enum class Side : std::uint8_t { unknown, outside, inside };

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<Side, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

using Vertices = std::map<std::uint32_t, Delaunay::Vertex_handle>;

void insert(Delaunay& plane, std::span<const Vec3d> vertices, std::span<const BorderEdge> border,
            const PlaneAxes& axes) {
  Vertices handles;
  const auto handle = [&](std::uint32_t v) {
    const auto [at, isNew] = handles.try_emplace(v);
    if (isNew) {
      const PlanePoint p = axes.of(vertices[v]);
      at->second = plane.insert(Kernel::Point_2(p.x, p.y));
      at->second->info() = v;
    }
    return at->second;
  };
  for (const BorderEdge& edge : border) {
    const auto from = handle(edge[0]), to = handle(edge[1]);
    if (from != to) plane.insert_constraint(from, to);
  }
}

// Each border crossed changes the side.
void markSides(Delaunay& plane) {
  plane.infinite_face()->info() = Side::outside;
  std::vector<Delaunay::Face_handle> open{plane.infinite_face()};
  while (!open.empty()) {
    const Delaunay::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Delaunay::Face_handle next = face->neighbor(i);
      if (next->info() != Side::unknown) continue;
      const bool crosses = plane.is_constrained({face, i});
      next->info() = crosses == (face->info() == Side::outside) ? Side::inside : Side::outside;
      open.push_back(next);
    }
  }
}

}  // namespace

Result<std::vector<Triangle>> capOf(std::span<const Vec3d> vertices, std::span<const BorderEdge> border,
                                    const HalfSpace& plane) try {
  Delaunay delaunay;
  insert(delaunay, vertices, border, PlaneAxes(plane));
  std::vector<Triangle> triangles;
  if (delaunay.dimension() < 2) return triangles;
  for (auto face = delaunay.all_faces_begin(); face != delaunay.all_faces_end(); ++face) face->info() = Side::unknown;
  markSides(delaunay);
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face)
    if (face->info() == Side::inside)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
} catch (const std::exception&) {
  return Error{
      "a cut crosses itself, the solid being too thin there for rounding; turn the mesh a little or give it thickness"};
}

}  // namespace cairn::builder
