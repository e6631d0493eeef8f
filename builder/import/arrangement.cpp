// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL.
#include "import/arrangement.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/intersections.h>

#include <limits>
#include <map>
#include <utility>

#include "import/self_intersection.h"

namespace cairn::builder {
namespace {

using Kernel = Arrangement::Kernel;
using Point = Kernel::Point_3;
using Line = std::pair<std::uint32_t, std::uint32_t>;  // between two points; both the same for a point alone

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
struct Number {
  std::uint32_t value = kNone;
};
using Faces = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>,
                                                   CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Plan = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Faces, CGAL::Exact_intersections_tag>;

struct Earlier {
  bool operator()(const Point& a, const Point& b) const { return CGAL::compare_xyz(a, b) == CGAL::SMALLER; }
};

/// Exact points with numbers; equal points have one.
class Points {
 public:
  explicit Points(const TriangleMesh& mesh) {
    for (const Vec3d& v : mesh.vertices) list.emplace_back(v.x, v.y, v.z);
  }
  void add(std::uint32_t vertex) { numbers_.emplace(list[vertex], vertex); }
  std::uint32_t operator()(const Point& p) {
    const auto [found, isNew] = numbers_.emplace(p, static_cast<std::uint32_t>(list.size()));
    if (isNew) list.push_back(p);
    return found->second;
  }
  std::vector<Point> list;

 private:
  std::map<Point, std::uint32_t, Earlier> numbers_;
};

/// Notes where two triangles meet, for both.
struct Meeting {
  Points& points;
  std::vector<Line>&a, &b;

  void add(const Point& from, const Point& to) const {
    const Line line{points(from), points(to)};
    a.push_back(line);
    b.push_back(line);
  }
  void operator()(const Point& p) const { add(p, p); }
  void operator()(const Kernel::Segment_3& s) const { add(s.source(), s.target()); }
  void operator()(const Kernel::Triangle_3& t) const {
    for (int i = 0; i < 3; ++i) add(t.vertex(i), t.vertex(i + 1));
  }
  void operator()(const std::vector<Point>& polygon) const {
    for (std::size_t i = 0; i < polygon.size(); ++i) add(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
};

/// A triangle seen along the axis it faces most, as a plan that keeps its sides.
class Divided {
 public:
  Divided(Points& points, const Triangle& corners) : points_(points) {
    const Point &a = points.list[corners[0]], &b = points.list[corners[1]], &c = points.list[corners[2]];
    const Kernel::Vector_3 normal = CGAL::cross_product(b - a, c - a);
    for (int axis = 1; axis < 3; ++axis)
      if (CGAL::abs(normal[axis]) > CGAL::abs(normal[along_])) along_ = axis;
    isTurned_ = normal[along_] < 0;
    plane_ = Kernel::Plane_3(a, normal);
    for (const std::uint32_t v : corners) vertex(v);
  }

  void cut(const Line& line) {
    const auto from = vertex(line.first);
    if (line.first != line.second) plan_.insert_constraint(from, vertex(line.second));
  }

  std::vector<Triangle> parts() {
    std::vector<Triangle> result;
    for (const auto& face : plan_.finite_face_handles()) {
      Triangle t{};
      for (int i = 0; i < 3; ++i) t[static_cast<std::size_t>(i)] = numberOf(face->vertex(i));
      if (isTurned_) std::swap(t[1], t[2]);
      result.push_back(t);
    }
    return result;
  }

 private:
  Plan::Vertex_handle vertex(std::uint32_t number) {
    const Point& p = points_.list[number];
    const auto handle = plan_.insert(Kernel::Point_2(p[(along_ + 1) % 3], p[(along_ + 2) % 3]));
    handle->info().value = number;
    return handle;
  }

  /// Cuts may cross in points of their own, which lie in the triangle's plane.
  std::uint32_t numberOf(const Plan::Vertex_handle& v) {
    if (v->info().value != kNone) return v->info().value;
    const Kernel::Point_2& p = v->point();
    const std::array<Kernel::FT, 3> normal{plane_.a(), plane_.b(), plane_.c()};
    std::array<Kernel::FT, 3> place;
    const auto axis = static_cast<std::size_t>(along_);
    place[(axis + 1) % 3] = p.x();
    place[(axis + 2) % 3] = p.y();
    place[axis] = -(normal[(axis + 1) % 3] * p.x() + normal[(axis + 2) % 3] * p.y() + plane_.d()) / normal[axis];
    return v->info().value = points_(Point(place[0], place[1], place[2]));
  }

  Points& points_;
  Kernel::Plane_3 plane_;
  int along_ = 0;
  bool isTurned_ = false;
  Plan plan_;
};

Kernel::Triangle_3 triangleOf(const Points& points, const Triangle& t) {
  return {points.list[t[0]], points.list[t[1]], points.list[t[2]]};
}

/// For each triangle that meets another one: the lines in which it does.
std::map<std::uint32_t, std::vector<Line>> cutsOf(const TriangleMesh& mesh, Points& points) {
  std::map<std::uint32_t, std::vector<Line>> cuts;
  const auto pairs = findSelfIntersections(mesh);
  for (const auto& [a, b] : pairs)
    for (const std::uint32_t t : {a, b})
      for (const std::uint32_t v : mesh.triangles[t]) points.add(v);
  for (const auto& [a, b] : pairs) {
    const auto common =
        CGAL::intersection(triangleOf(points, mesh.triangles[a]), triangleOf(points, mesh.triangles[b]));
    if (common) boost::apply_visitor(Meeting{points, cuts[a], cuts[b]}, *common);
  }
  return cuts;
}

}  // namespace

Arrangement arrange(const TriangleMesh& mesh) {
  Points points(mesh);
  const std::map<std::uint32_t, std::vector<Line>> cuts = cutsOf(mesh, points);
  Arrangement result;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::vector<Triangle> parts{mesh.triangles[t]};
    if (const auto found = cuts.find(t); found != cuts.end()) {
      Divided divided(points, mesh.triangles[t]);
      for (const Line& line : found->second) divided.cut(line);
      parts = divided.parts();
    }
    result.cutTriangles += parts.size() > 1 ? 1 : 0;
    result.triangles.insert(result.triangles.end(), parts.begin(), parts.end());
    result.source.insert(result.source.end(), parts.size(), t);
  }
  result.points = std::move(points.list);
  return result;
}

}  // namespace cairn::builder
