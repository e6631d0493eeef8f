// SPDX-License-Identifier: GPL-3.0-or-later
//
// One of the few files that see CGAL. Its edge collapse keeps the surface a closed manifold, and keeps the queue.
#include "coarse/collapse_by_distance.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "coarse/fan_crossings.h"
#include "coarse/triangle_fan.h"
#include "import/surface_mesh.h"

namespace cairn::builder {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Vertex = Surface::Vertex_index;
using Face = Surface::Face_index;
using Halfedge = Surface::Halfedge_index;
using Profile = sms::Edge_profile<Surface>;

/// A triangle stands for so many points of the source at most. More cost time, and change the choice little.
constexpr std::size_t kMaxPoints = 24;
/// Of collapses that leave the same distance, those of short edges go first: this part of their length is added.
constexpr double kLengthShare = 1e-4;

Vec3d toVec(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

std::array<Vertex, 3> verticesOf(const Surface& surface, Halfedge h) {
  return {surface.target(h), surface.target(surface.next(h)), surface.source(h)};
}

struct Place {
  Point at;
  double distance = 0;  ///< the greatest one that a collapse to this place leaves
};

}  // namespace

struct CollapseByDistance::Impl {
  const SurfaceDistance& distanceToSource;
  Surface surface;
  std::vector<std::vector<Vec3d>> pointsOf;  // by face: points of the source that it stands for
  TriangleFan fan;                           // the rest is working memory
  FanCrossings<Kernel> crossings;
  std::vector<Vec3d> points;
  std::vector<Face> faces;

  Impl(const TriangleMesh& start, const TriangleMesh& source, const SurfaceDistance& distanceToSource);
  void spreadPoints(const TriangleMesh& start, const TriangleMesh& source);
  bool cutsThroughItself(const Profile& profile, const Point& at);
  std::optional<double> distanceAfter(const Profile& profile, const Point& at, double limit);
  std::optional<Place> bestPlace(const Profile& profile);
  void takePoints(const Profile& profile);
  void givePoints(Vertex vertex);

  // What CGAL asks for. It copies these, so they only refer.
  struct Placing {
    Impl* impl;
    boost::optional<Point> operator()(const Profile& profile) const {
      const std::optional<Place> place = impl->bestPlace(profile);
      return place ? boost::optional<Point>(place->at) : boost::none;
    }
  };
  struct Cost {
    Impl* impl;
    boost::optional<double> operator()(const Profile& profile, const boost::optional<Point>& at) const {
      constexpr double kNoLimit = std::numeric_limits<double>::infinity();
      const std::optional<double> left = at ? impl->distanceAfter(profile, *at, kNoLimit) : std::nullopt;
      if (!left) return boost::none;
      return *left + kLengthShare * length(toVec(profile.p0()) - toVec(profile.p1()));
    }
  };
  struct Filter {
    Impl* impl;
    boost::optional<Point> operator()(const Profile& profile, const boost::optional<Point>& at) const {
      return at && !impl->cutsThroughItself(profile, *at) ? at : boost::none;
    }
  };
  struct Visitor : sms::Edge_collapse_visitor_base<Surface> {
    Impl* impl;
    explicit Visitor(Impl* of) : impl(of) {}
    void OnCollapsing(const Profile& profile, const boost::optional<Point>&) { impl->takePoints(profile); }
    void OnCollapsed(const Profile&, const Vertex& vertex) { impl->givePoints(vertex); }
  };
  struct Stop {
    std::size_t edges;
    const KeepGoing* keepGoing;
    bool* cancelled;
    template <class AnyCost>
    bool operator()(const AnyCost&, const Profile&, std::size_t, std::size_t current) const {
      *cancelled = *cancelled || !(*keepGoing)();
      return current < edges || *cancelled;
    }
  };
};

CollapseByDistance::Impl::Impl(const TriangleMesh& start, const TriangleMesh& source, const SurfaceDistance& distance)
    : distanceToSource(distance), surface(surfaceFrom<Point>(start)), pointsOf(surface.number_of_faces()) {
  if (!surface.is_empty()) spreadPoints(start, source);
}

// Faces are numbered like the triangles they were made of.
void CollapseByDistance::Impl::spreadPoints(const TriangleMesh& start, const TriangleMesh& source) {
  const SurfaceDistance toStart(start);
  const auto give = [&](const Vec3d& point) { pointsOf[toStart.closest(point).triangle].push_back(point); };
  for (const Vec3d& vertex : source.vertices) give(vertex);
  for (std::uint32_t t = 0; t < source.triangles.size(); ++t) {
    const auto [a, b, c] = source.corners(t);
    give((a + b + c) / 3.0);
  }
  for (std::vector<Vec3d>& own : pointsOf) keepSpread(own, kMaxPoints);
}

bool CollapseByDistance::Impl::cutsThroughItself(const Profile& profile, const Point& at) {
  crossings.begin(at);
  const auto isEnd = [&](Vertex v) { return v == profile.v0() || v == profile.v1(); };
  for (const Vertex end : {profile.v0(), profile.v1()})
    for (const Halfedge h : CGAL::halfedges_around_target(end, surface)) {
      const std::array<Vertex, 3> corners = verticesOf(surface, h);
      if (!isEnd(corners[1]) && !isEnd(corners[2])) crossings.add(surface, corners[1], corners[2]);
    }
  return crossings.any(surface,
                       [&](const std::array<Vertex, 3>& corners) { return std::ranges::any_of(corners, isEnd); });
}

// Faces with both ends vanish; they are met at the first end.
std::optional<double> CollapseByDistance::Impl::distanceAfter(const Profile& profile, const Point& at, double limit) {
  fan.clear();
  points.clear();
  for (const Vertex end : {profile.v0(), profile.v1()})
    for (const Halfedge h : CGAL::halfedges_around_target(end, surface)) {
      const std::array<Vertex, 3> corners = verticesOf(surface, h);
      const Vertex other = end == profile.v0() ? profile.v1() : profile.v0();
      const bool vanishes = corners[1] == other || corners[2] == other;
      const std::vector<Vec3d>& own = pointsOf[surface.face(h)];
      if (!vanishes || end == profile.v0()) points.insert(points.end(), own.begin(), own.end());
      if (vanishes) continue;
      const Vec3d b = toVec(surface.point(corners[1])), c = toVec(surface.point(corners[2]));
      if (!fan.add({toVec(surface.point(end)), b, c}, {toVec(at), b, c})) return {};
    }
  return fan.distanceTo(distanceToSource, points, limit);
}

std::optional<Place> CollapseByDistance::Impl::bestPlace(const Profile& profile) {
  std::optional<Place> best;
  const auto offer = [&](const Point& at) {
    const double limit = best ? best->distance : std::numeric_limits<double>::infinity();
    if (const std::optional<double> left = distanceAfter(profile, at, limit)) best = Place{at, *left};
  };
  if (const boost::optional<Point> at = sms::LindstromTurk_placement<Surface>()(profile)) offer(*at);
  offer(profile.p0());
  offer(profile.p1());
  offer(CGAL::midpoint(profile.p0(), profile.p1()));
  return best;
}

void CollapseByDistance::Impl::takePoints(const Profile& profile) {
  points.clear();
  for (const Vertex end : {profile.v0(), profile.v1()})
    for (const Halfedge h : CGAL::halfedges_around_target(end, surface)) {
      std::vector<Vec3d>& own = pointsOf[surface.face(h)];
      points.insert(points.end(), own.begin(), own.end());
      own.clear();
    }
}

void CollapseByDistance::Impl::givePoints(Vertex vertex) {
  fan.clear();
  faces.clear();
  for (const Halfedge h : CGAL::halfedges_around_target(vertex, surface)) {
    const auto [u, v, w] = verticesOf(surface, h);
    const std::array<Vec3d, 3> corners{toVec(surface.point(u)), toVec(surface.point(v)), toVec(surface.point(w))};
    if (fan.add(corners, corners)) faces.push_back(surface.face(h));
  }
  if (faces.empty()) return;
  for (const Vec3d& point : points) pointsOf[faces[fan.nearest(point)]].push_back(point);
  for (const Face face : faces) keepSpread(pointsOf[face], kMaxPoints);
}

CollapseByDistance::CollapseByDistance(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CollapseByDistance::~CollapseByDistance() = default;

std::unique_ptr<CollapseByDistance> CollapseByDistance::create(const TriangleMesh& start, const TriangleMesh& source,
                                                               const SurfaceDistance& distanceToSource) {
  auto impl = std::make_unique<Impl>(start, source, distanceToSource);
  if (impl->surface.is_empty()) return nullptr;
  return std::unique_ptr<CollapseByDistance>(new CollapseByDistance(std::move(impl)));
}

bool CollapseByDistance::collapseTo(std::uint32_t triangles, const KeepGoing& keepGoing) {
  if (impl_->surface.number_of_faces() <= triangles) return true;
  bool cancelled = false;
  // Every edge of a closed mesh has two triangles, every triangle three edges.
  const Impl::Stop stop{std::size_t{triangles} / 2 * 3 + 1, &keepGoing, &cancelled};
  sms::edge_collapse(impl_->surface, stop,
                     CGAL::parameters::get_cost(Impl::Cost{impl_.get()})
                         .get_placement(Impl::Placing{impl_.get()})
                         .filter(Impl::Filter{impl_.get()})
                         .visitor(Impl::Visitor(impl_.get())));
  return !cancelled;
}

TriangleMesh CollapseByDistance::mesh() const {
  return meshFrom(impl_->surface);
}

}  // namespace cairn::builder
