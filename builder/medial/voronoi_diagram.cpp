// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi_diagram.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cassert>
#include <iterator>

namespace cairn::builder {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

constexpr std::uint32_t kUnbounded = ~0U;
/// Distance of the enclosing sites from the middle, in diagonals of the bounds: far enough that their vertices lie
/// outside.
constexpr double kEnclosingDistance = 4;

/// The result is not finite for coplanar points. CGAL's own construction refuses these, in debug builds only.
Vec3d circumcenter(const Vec3d& origin, const Vec3d& p, const Vec3d& q, const Vec3d& r) {
  const Vec3d a = p - origin, b = q - origin, c = r - origin;
  const Vec3d normals = cross(b, c) * lengthSq(a) + cross(c, a) * lengthSq(b) + cross(a, b) * lengthSq(c);
  return origin + normals / (2 * dot(a, cross(b, c)));
}

}  // namespace

struct VoronoiDiagram::Triangulation {
  Delaunay delaunay;
  std::vector<VoronoiVertex> vertices;
  std::vector<Delaunay::Cell_handle> cells;  // by vertex; dangling for the dead
  std::vector<Vec3d> sites;
  std::uint32_t firstOfLastInsert = 0;
  std::vector<std::uint32_t> endedByLastInsert;

  void addVertex(Delaunay::Cell_handle cell) {
    if (delaunay.is_infinite(cell)) {
      cell->info() = kUnbounded;
      return;
    }
    cell->info() = static_cast<std::uint32_t>(vertices.size());
    VoronoiVertex vertex;
    for (int i = 0; i < 4; ++i) vertex.sites[i] = cell->vertex(i)->info();
    const auto& s = vertex.sites;
    vertex.position = circumcenter(sites[s[0]], sites[s[1]], sites[s[2]], sites[s[3]]);
    vertices.push_back(vertex);
    cells.push_back(cell);
  }

  void end(const std::vector<Delaunay::Cell_handle>& conflicts) {
    endedByLastInsert.clear();
    for (const Delaunay::Cell_handle cell : conflicts) {
      if (cell->info() == kUnbounded) continue;
      vertices[cell->info()].alive = false;
      endedByLastInsert.push_back(cell->info());
    }
  }

  std::uint32_t addSite(const Vec3d& site) {
    sites.push_back(site);
    return static_cast<std::uint32_t>(sites.size() - 1);
  }
};

VoronoiDiagram::VoronoiDiagram(const Bounds& bounds) : triangulation_(std::make_unique<Triangulation>()) {
  assert(bounds.diagonal() > 0);
  Triangulation& t = *triangulation_;
  const Vec3d center = bounds.center();
  const double reach = kEnclosingDistance * bounds.diagonal();
  for (int i = 0; i < 8; ++i) {
    const Vec3d corner =
        center + Vec3d((i & 1) != 0 ? reach : -reach, (i & 2) != 0 ? reach : -reach, (i & 4) != 0 ? reach : -reach);
    t.delaunay.insert(Kernel::Point_3(corner.x, corner.y, corner.z))->info() = t.addSite(corner);
  }
  for (auto cell = t.delaunay.all_cells_begin(); cell != t.delaunay.all_cells_end(); ++cell) t.addVertex(cell);
}

VoronoiDiagram::~VoronoiDiagram() = default;
VoronoiDiagram::VoronoiDiagram(VoronoiDiagram&&) noexcept = default;
VoronoiDiagram& VoronoiDiagram::operator=(VoronoiDiagram&&) noexcept = default;

bool VoronoiDiagram::insert(const Vec3d& site, std::uint32_t near) {
  Triangulation& t = *triangulation_;
  assert(near < t.vertices.size() && t.vertices[near].alive);
  const Kernel::Point_3 point(site.x, site.y, site.z);
  Delaunay::Locate_type type;
  int i = 0, j = 0;
  const Delaunay::Cell_handle home = t.delaunay.locate(point, type, i, j, t.cells[near]);
  if (type == Delaunay::VERTEX) return false;
  assert(type != Delaunay::OUTSIDE_CONVEX_HULL && type != Delaunay::OUTSIDE_AFFINE_HULL);

  std::vector<Delaunay::Cell_handle> conflicts;
  Delaunay::Facet boundary;
  t.delaunay.find_conflicts(point, home, CGAL::Oneset_iterator<Delaunay::Facet>(boundary),
                            std::back_inserter(conflicts));
  t.end(conflicts);
  const Delaunay::Vertex_handle vertex =
      t.delaunay.insert_in_hole(point, conflicts.begin(), conflicts.end(), boundary.first, boundary.second);
  vertex->info() = t.addSite(site);
  t.firstOfLastInsert = static_cast<std::uint32_t>(t.vertices.size());
  std::vector<Delaunay::Cell_handle> created;
  t.delaunay.incident_cells(vertex, std::back_inserter(created));
  for (const Delaunay::Cell_handle cell : created) t.addVertex(cell);
  return true;
}

bool VoronoiDiagram::insert(const Vec3d& site) {
  // The vertices of the last insertion are alive until the next one.
  return insert(site, static_cast<std::uint32_t>(triangulation_->vertices.size() - 1));
}

std::span<const VoronoiVertex> VoronoiDiagram::vertices() const {
  return triangulation_->vertices;
}
std::uint32_t VoronoiDiagram::firstOfLastInsert() const {
  return triangulation_->firstOfLastInsert;
}
std::span<const std::uint32_t> VoronoiDiagram::endedByLastInsert() const {
  return triangulation_->endedByLastInsert;
}
const Vec3d& VoronoiDiagram::site(std::uint32_t index) const {
  return triangulation_->sites[index];
}
std::uint32_t VoronoiDiagram::siteCount() const {
  return static_cast<std::uint32_t>(triangulation_->sites.size());
}

}  // namespace cairn::builder
