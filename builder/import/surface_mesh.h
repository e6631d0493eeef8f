// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Surface_mesh.h>

#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Converts a CGAL surface to a mesh in the same frame and unit, without a name. Vertices are numbered anew in their
/// order, so removed vertices leave no hole in the numbers. Precondition: every face is a triangle. Linear. Only for
/// files that include CGAL already.
template <class Point>
TriangleMesh meshFrom(const CGAL::Surface_mesh<Point>& surface) {
  using Surface = CGAL::Surface_mesh<Point>;
  TriangleMesh mesh;
  std::vector<std::uint32_t> numbers(surface.num_vertices() + surface.number_of_removed_vertices());
  for (const typename Surface::Vertex_index v : surface.vertices()) {
    numbers[v] = static_cast<std::uint32_t>(mesh.vertices.size());
    const Point& p = surface.point(v);
    mesh.vertices.push_back({p.x(), p.y(), p.z()});
  }
  for (const typename Surface::Face_index f : surface.faces()) {
    Triangle& t = mesh.triangles.emplace_back();
    auto corner = t.begin();
    for (const typename Surface::Vertex_index v : CGAL::vertices_around_face(surface.halfedge(f), surface))
      *corner++ = numbers[v];
  }
  return mesh;
}

/// Converts a mesh to a CGAL surface with the same numbers of vertices and faces. Empty when a vertex is pinched, which
/// a halfedge structure cannot represent. Linear.
template <class Point>
CGAL::Surface_mesh<Point> surfaceFrom(const TriangleMesh& mesh) {
  using Surface = CGAL::Surface_mesh<Point>;
  Surface surface;
  std::vector<typename Surface::Vertex_index> names;
  for (const Vec3d& v : mesh.vertices) names.push_back(surface.add_vertex(Point(v.x, v.y, v.z)));
  for (const Triangle& t : mesh.triangles)
    if (surface.add_face(names[t[0]], names[t[1]], names[t[2]]) == Surface::null_face()) return {};
  return surface;
}

}  // namespace cairn::builder
