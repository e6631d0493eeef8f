// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Bbox_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <vector>

namespace cairn::builder {

/// Whether the triangles that a collapse would leave around a vertex cut through each other or through the rest of the
/// surface, by exact predicates. It looks at every face: next to what the choice of a collapse costs that is little.
/// Only for files that include CGAL already.
template <class Kernel>
class FanCrossings {
 public:
  using Point = typename Kernel::Point_3;
  using Surface = CGAL::Surface_mesh<Point>;
  using Vertex = typename Surface::Vertex_index;
  using Face = typename Surface::Face_index;
  /// Vertices of a face. In the fan the first one is the vertex that is moved.
  using Corners = std::array<Vertex, 3>;

  void begin(const Point& at) {
    at_ = at;
    fan_.clear();
    boxes_.clear();
    all_ = at.bbox();
  }
  /// A triangle of the fan: the moved vertex, and two of the surface.
  void add(const Surface& surface, Vertex b, Vertex c) {
    const Triangle triangle(at_, surface.point(b), surface.point(c));
    fan_.push_back({triangle, b, c});
    boxes_.push_back(triangle.bbox());
    all_ += boxes_.back();
  }

  /// `isGone(corners)`: whether the collapse removes a face, or moves one of its vertices.
  template <class IsGone>
  bool any(const Surface& surface, const IsGone& isGone) const {
    return anyInFan() || std::ranges::any_of(surface.faces(), [&](Face face) {
             const auto h = surface.halfedge(face);
             const Corners corners{surface.target(h), surface.target(surface.next(h)), surface.source(h)};
             const Triangle triangle(surface.point(corners[0]), surface.point(corners[1]), surface.point(corners[2]));
             return CGAL::do_overlap(all_, triangle.bbox()) && !isGone(corners) && crosses(triangle, corners);
           });
  }

 private:
  using Triangle = typename Kernel::Triangle_3;
  using Segment = typename Kernel::Segment_3;
  struct Blade {
    Triangle triangle;
    Vertex b, c;
  };

  // Two triangles of the fan share the moved vertex. They cross only where the far side of one meets the other.
  bool anyInFan() const {
    for (const Blade& x : fan_)
      for (const Blade& y : fan_) {
        const bool areNeighbours = x.b == y.b || x.b == y.c || x.c == y.b || x.c == y.c;
        if (!areNeighbours && CGAL::do_intersect(Segment(x.triangle[1], x.triangle[2]), y.triangle)) return true;
      }
    return false;
  }

  bool crosses(const Triangle& triangle, const Corners& corners) const {
    for (std::size_t i = 0; i < fan_.size(); ++i)
      if (CGAL::do_overlap(boxes_[i], triangle.bbox()) && crosses(fan_[i], triangle, corners)) return true;
    return false;
  }

  static bool crosses(const Blade& blade, const Triangle& triangle, const Corners& corners) {
    const auto atB = std::ranges::find(corners, blade.b), atC = std::ranges::find(corners, blade.c);
    if (atB == corners.end() && atC == corners.end()) return CGAL::do_intersect(blade.triangle, triangle);
    if (atB != corners.end() && atC != corners.end()) return false;  // neighbours; the collapse keeps their angle
    const bool isB = atB != corners.end();
    const auto shared = static_cast<int>((isB ? atB : atC) - corners.begin());
    const Segment farSide(triangle[(shared + 1) % 3], triangle[(shared + 2) % 3]);
    const Segment ownSide(blade.triangle[0], blade.triangle[isB ? 2 : 1]);
    return CGAL::do_intersect(farSide, blade.triangle) || CGAL::do_intersect(ownSide, triangle);
  }

  Point at_;
  std::vector<Blade> fan_;
  std::vector<CGAL::Bbox_3> boxes_;
  CGAL::Bbox_3 all_;
};

}  // namespace cairn::builder
