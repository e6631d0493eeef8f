// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/truth/exact_check.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace cairn::scenes {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Facet = Kernel::Triangle_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Side = CGAL::Side_of_triangle_mesh<Mesh, Kernel>;

using Piece = std::array<Vec3d, 3>;

Point toPoint(const Vec3d& v) {
  return {v.x, v.y, v.z};
}
Vec3d toVec3d(const Point& p) {
  return {p.x(), p.y(), p.z()};
}
Facet toFacet(const Piece& piece) {
  return {toPoint(piece[0]), toPoint(piece[1]), toPoint(piece[2])};
}
CGAL::Bbox_3 inflated(const CGAL::Bbox_3& box, double by) {
  return {box.xmin() - by, box.ymin() - by, box.zmin() - by, box.xmax() + by, box.ymax() + by, box.zmax() + by};
}

}  // namespace

struct ExactSurface::Impl {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Mesh mesh;
  Tree tree;
  std::unique_ptr<Side> side;

  bool contains(const Vec3d& p) const { return (*side)(toPoint(p)) == CGAL::ON_BOUNDED_SIDE; }
  double distanceSq(const Vec3d& p) const { return tree.squared_distance(toPoint(p)); }

  /// The nearest triangle and the distance to it.
  std::pair<Facet, double> nearest(const Vec3d& p) const {
    const auto [point, face] = tree.closest_point_and_primitive(toPoint(p));
    return {facet(face), distance(p, toVec3d(point))};
  }
  Facet facet(Mesh::Face_index face) const {
    const auto h = mesh.halfedge(face);
    return {mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h)))};
  }
  Piece corners(std::size_t triangle) const {
    const auto& [i, j, k] = triangles[triangle];
    return {vertices[i], vertices[j], vertices[k]};
  }
};

Placement Placement::inverse() const {
  const Mat3d back = transpose(rotation);
  return {back, -(back * translation)};
}

Placement operator*(const Placement& outer, const Placement& inner) {
  return {outer.rotation * inner.rotation, outer * inner.translation};
}

ExactSurface::ExactSurface(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ExactSurface::~ExactSurface() = default;
ExactSurface::ExactSurface(ExactSurface&&) noexcept = default;
ExactSurface& ExactSurface::operator=(ExactSurface&&) noexcept = default;

Result<ExactSurface> ExactSurface::create(std::span<const Vec3d> vertices,
                                          std::span<const std::array<std::uint32_t, 3>> triangles) {
  auto impl = std::make_unique<Impl>();
  impl->vertices.assign(vertices.begin(), vertices.end());
  impl->triangles.assign(triangles.begin(), triangles.end());
  std::vector<Mesh::Vertex_index> names;
  for (const Vec3d& v : vertices) names.push_back(impl->mesh.add_vertex(toPoint(v)));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [i, j, k] = triangles[t];
    if (i >= names.size() || j >= names.size() || k >= names.size())
      return Error{"triangle " + std::to_string(t) + " names a vertex that does not exist"};
    if (impl->mesh.add_face(names[i], names[j], names[k]) == Mesh::null_face())
      return Error{"triangle " + std::to_string(t) + " makes the surface non-manifold or inconsistently oriented"};
  }
  if (triangles.empty() || !CGAL::is_closed(impl->mesh)) return Error{"the surface is not closed"};
  impl->tree.insert(faces(impl->mesh).first, faces(impl->mesh).second, impl->mesh);
  impl->tree.build();
  impl->tree.accelerate_distance_queries();
  impl->side = std::make_unique<Side>(impl->tree);
  return ExactSurface(std::move(impl));
}

double ExactSurface::depth(const Vec3d& point) const {
  const double distance = std::sqrt(impl_->distanceSq(point));
  return impl_->contains(point) ? distance : -distance;
}

double ExactSurface::distanceTo(const Vec3d& point) const {
  return std::sqrt(impl_->distanceSq(point));
}

namespace {

/// Branch and bound for `penetration`, in the frame of the solid.
class DepthSearch {
 public:
  DepthSearch(const ExactSurface::Impl& solid, double tolerance, double known)
      : solid_(solid), tolerance_(tolerance), best_(known) {}

  void tryPoint(const Vec3d& p) {
    if (!CGAL::do_overlap(toPoint(p).bbox(), solid_.tree.bbox())) return;
    // Most points are outside, which is known faster than how far.
    if (solid_.contains(p)) best_ = std::max(best_, std::sqrt(solid_.distanceSq(p)));
  }

  void search(const Piece& triangle) {
    // A triangle that does not meet the surface lies on one side of it, and most lie outside.
    const Facet facet = toFacet(triangle);
    if (!CGAL::do_overlap(facet.bbox(), solid_.tree.bbox())) return;
    if (!solid_.contains(triangle[0]) && !solid_.tree.do_intersect(facet)) return;
    stack_.push_back(triangle);
    while (!stack_.empty()) {
      const Piece piece = stack_.back();
      stack_.pop_back();
      if (CGAL::do_overlap(toFacet(piece).bbox(), solid_.tree.bbox())) refine(piece);
    }
  }

  double best() const { return best_; }

 private:
  void refine(const Piece& piece) {
    const Vec3d center = (piece[0] + piece[1] + piece[2]) / 3.0;
    const auto [facet, distanceToSolid] = solid_.nearest(center);
    double bound = 0, reach = 0;
    for (const Vec3d& corner : piece) {
      bound = std::max(bound, std::sqrt(CGAL::squared_distance(toPoint(corner), facet)));
      reach = std::max(reach, distance(corner, center));
    }
    if (bound <= best_ + tolerance_) return;
    const bool inside = solid_.contains(center);
    if (inside) best_ = std::max(best_, distanceToSolid);
    // A piece that cannot reach the solid's surface lies on the side of its centre.
    if (!inside && distanceToSolid > reach) return;
    if (bound > best_ + tolerance_) split(piece);
  }

  void split(const Piece& p) {
    const Vec3d ab = (p[0] + p[1]) * 0.5, bc = (p[1] + p[2]) * 0.5, ca = (p[2] + p[0]) * 0.5;
    stack_.insert(stack_.end(), {Piece{p[0], ab, ca}, {ab, p[1], bc}, {ca, bc, p[2]}, {ab, bc, ca}});
  }

  const ExactSurface::Impl& solid_;
  double tolerance_;
  double best_;
  std::vector<Piece> stack_;
};

double nearestVertexSq(const ExactSurface::Impl& points, const ExactSurface::Impl& surface,
                       const Placement& placement) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec3d& v : points.vertices) {
    const Vec3d p = placement * v;
    // Farther from the box than the best distance so far, so the tree need not be searched.
    const double reach = std::sqrt(best);
    if (std::isfinite(reach) && !CGAL::do_overlap(toPoint(p).bbox(), inflated(surface.tree.bbox(), reach))) continue;
    best = std::min(best, surface.distanceSq(p));
  }
  return best;
}

double edgeDistanceSq(const Facet& a, const Facet& b) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      best = std::min(best, CGAL::squared_distance(Segment(a[i], a[(i + 1) % 3]), Segment(b[j], b[(j + 1) % 3])));
  return best;
}

}  // namespace

double penetration(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA, double tolerance,
                   double known) {
  assert(tolerance > 0 && known >= 0);
  DepthSearch search(b.impl(), tolerance, known);
  for (const Vec3d& v : a.impl().vertices) search.tryPoint(bFromA * v);
  for (std::size_t t = 0; t < a.impl().triangles.size(); ++t) {
    Piece piece = a.impl().corners(t);
    for (Vec3d& corner : piece) corner = bFromA * corner;
    search.search(piece);
  }
  return search.best();
}

double mutualPenetration(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA, double tolerance,
                         double known) {
  return penetration(b, a, bFromA.inverse(), tolerance, penetration(a, b, bFromA, tolerance, known));
}

bool surfacesMeet(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA) {
  const CGAL::Bbox_3 room = b.impl().tree.bbox();
  std::vector<Vec3d> placed;
  for (const Vec3d& v : a.impl().vertices) placed.push_back(bFromA * v);
  return std::ranges::any_of(a.impl().triangles, [&](const auto& triangle) {
    const Facet facet = toFacet({placed[triangle[0]], placed[triangle[1]], placed[triangle[2]]});
    return CGAL::do_overlap(facet.bbox(), room) && b.impl().tree.do_intersect(facet);
  });
}

double surfaceDistance(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA) {
  double bestSq =
      std::min(nearestVertexSq(a.impl(), b.impl(), bFromA), nearestVertexSq(b.impl(), a.impl(), bFromA.inverse()));
  std::vector<Tree::Primitive_id> candidates;
  for (std::size_t t = 0; t < a.impl().triangles.size() && bestSq > 0; ++t) {
    Piece piece = a.impl().corners(t);
    for (Vec3d& corner : piece) corner = bFromA * corner;
    const Facet facet = toFacet(piece);
    candidates.clear();
    b.impl().tree.all_intersected_primitives(inflated(facet.bbox(), std::sqrt(bestSq)), std::back_inserter(candidates));
    for (const Tree::Primitive_id face : candidates) {
      const Facet other = b.impl().facet(face);
      if (CGAL::do_intersect(facet, other)) return 0;
      bestSq = std::min(bestSq, edgeDistanceSq(facet, other));
    }
  }
  return std::sqrt(bestSq);
}

}  // namespace cairn::scenes
