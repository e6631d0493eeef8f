// SPDX-License-Identifier: GPL-3.0-or-later
#include "medial/gap_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace cairn::builder {

namespace {

/// A line shorter than this fraction of the samples' spacing counts as a touch, because faces between samples of one
/// cluster end at its edges.
constexpr double kTouch = 0.01;

/// The common face of two Voronoi cells: a convex polygon in the plane halfway between the samples.
struct Face {
  std::uint32_t a = 0, b = 0;  // samples
  std::vector<Vec3d> corners;  // in order
  Vec3d normal;                // unit
};

/// The faces between samples whose corners are all known, with the corners in order.
std::vector<Face> boundedFaces(const VoronoiDiagram& diagram) {
  using Entry = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // samples, vertex
  std::vector<Entry> entries;
  const auto vertices = diagram.vertices();
  constexpr std::uint32_t kFirst = VoronoiDiagram::kEnclosingSites;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    if (!vertices[v].alive) continue;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 4; ++k) {
        const std::uint32_t a = vertices[v].sites[i], b = vertices[v].sites[k];
        if (a < b && a >= kFirst) entries.emplace_back(a - kFirst, b - kFirst, v);
      }
  }
  std::sort(entries.begin(), entries.end());
  std::vector<Face> faces;
  for (std::size_t first = 0, end = 0; first < entries.size(); first = end) {
    Face face{std::get<0>(entries[first]), std::get<1>(entries[first]), {}, {}};
    bool known = true;
    for (end = first;
         end < entries.size() && std::get<0>(entries[end]) == face.a && std::get<1>(entries[end]) == face.b; ++end) {
      face.corners.push_back(vertices[std::get<2>(entries[end])].position);
      known = known && isFinite(face.corners.back());
    }
    if (!known || face.corners.size() < 3) continue;
    face.normal = normalized(diagram.site(face.b + kFirst) - diagram.site(face.a + kFirst));
    faces.push_back(std::move(face));
  }
  return faces;
}

/// Sorts the corners around their middle; the face is convex.
void putInOrder(Face& face) {
  Vec3d middle;
  for (const Vec3d& c : face.corners) middle += c / static_cast<double>(face.corners.size());
  const Vec3d axis = std::abs(face.normal.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  const Vec3d u = normalized(cross(face.normal, axis)), v = cross(face.normal, u);
  const auto angle = [&](const Vec3d& c) { return std::atan2(dot(c - middle, v), dot(c - middle, u)); };
  std::sort(face.corners.begin(), face.corners.end(),
            [&](const Vec3d& p, const Vec3d& q) { return angle(p) < angle(q); });
}

/// Returns the length of the line in which a face and a triangle meet, 0 when they do not.
double meetingLength(const Face& face, const std::array<Vec3d, 3>& corners) {
  std::array<double, 3> height{};
  for (int i = 0; i < 3; ++i) height[i] = dot(corners[i] - face.corners[0], face.normal);
  std::vector<Vec3d> ends;
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3;
    if ((height[i] < 0) == (height[k] < 0)) continue;
    ends.push_back(corners[i] + (corners[k] - corners[i]) * (height[i] / (height[i] - height[k])));
  }
  if (ends.size() != 2) return 0;
  double from = 0, to = 1;
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const Vec3d& corner = face.corners[i];
    const Vec3d inward = cross(face.normal, face.corners[(i + 1) % face.corners.size()] - corner);
    const double start = dot(ends[0] - corner, inward), change = dot(ends[1] - ends[0], inward);
    if (change > 0) from = std::max(from, -start / change);
    if (change < 0) to = std::min(to, -start / change);
    if (change == 0 && start < 0) return 0;
  }
  return from < to ? (to - from) * distance(ends[0], ends[1]) : 0;
}

/// Calls `visit(triangle)` for triangles whose boxes may meet the box; some twice.
template <class Visit>
void visitTriangles(const TriangleHierarchy& hierarchy, const Bounds& box, const Visit& visit) {
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const HierarchyNode& node = hierarchy.node(stack.back());
    stack.pop_back();
    for (int lane = 0; lane < HierarchyNode::kWidth; ++lane) {
      bool apart = false;
      for (int axis = 0; axis < 3; ++axis)
        apart = apart || node.lower[axis][lane] > box.upper[axis] || node.upper[axis][lane] < box.lower[axis];
      if (apart) continue;
      if ((node.child[lane] & HierarchyNode::kPacketBit) == 0) {
        stack.push_back(node.child[lane]);
        continue;
      }
      for (const std::uint32_t t : hierarchy.packet(node.child[lane] & ~HierarchyNode::kPacketBit).triangle) visit(t);
    }
  }
}

class Repair {
 public:
  Repair(const std::vector<ClusterSample>& samples, const TriangleMesh& mesh, const TriangleHierarchy& hierarchy,
         const PlanarClusters& clusters, double spacing)
      : samples_(samples), mesh_(mesh), hierarchy_(hierarchy), clusters_(clusters), spacing_(spacing) {
    for (const ClusterSample& s : samples) taken_.insert(cellOf(s.point));
  }

  void check(Face face) {
    putInOrder(face);
    Bounds box{face.corners[0], face.corners[0]};
    for (const Vec3d& c : face.corners)
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], c[axis]);
        box.upper[axis] = std::max(box.upper[axis], c[axis]);
      }
    std::set<std::uint32_t> crossed;
    visitTriangles(hierarchy_, box, [&](std::uint32_t t) {
      const std::uint32_t cluster = clusters_.ofTriangle[t];
      if (crossed.contains(cluster) || (samples_[face.a].liesOn(cluster) && samples_[face.b].liesOn(cluster))) return;
      if (meetingLength(face, mesh_.corners(t)) > kTouch * spacing_) crossed.insert(cluster);
    });
    for (const std::uint32_t cluster : crossed) mend(face, cluster);
  }

  std::vector<ClusterSample> take() { return std::move(added_); }

 private:
  using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  Cell cellOf(const Vec3d& p) const {
    return {std::llround(p.x / spacing_), std::llround(p.y / spacing_), std::llround(p.z / spacing_)};
  }

  void mend(const Face& face, std::uint32_t cluster) {
    std::optional<Vec3d> snapped;
    bool inside = false;
    for (const std::uint32_t s : {face.a, face.b}) {
      if (samples_[s].liesOn(cluster)) continue;
      const Vec3d& origin = mesh_.vertices[mesh_.triangles[clusters_.triangles[cluster][0]][0]];
      const Vec3d& normal = clusters_.normals[cluster];
      const Vec3d projected = samples_[s].point - normal * dot(samples_[s].point - origin, normal);
      const Vec3d closest = closestOn(cluster, projected);
      if (!snapped) snapped = closest;
      if (distance(closest, projected) > kTouch * spacing_) continue;
      inside = true;
      add(closest, cluster);
    }
    if (!inside && snapped) add(*snapped, cluster);
  }

  Vec3d closestOn(std::uint32_t cluster, const Vec3d& point) const {
    Vec3d best;
    double bestSq = std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : clusters_.triangles[cluster]) {
      const TriangleHierarchy::Place place = hierarchy_.placeOf(t);
      const Vec3d offset = hierarchy_.packet(place.packet).nearest(place.lane, point).offset;
      if (lengthSq(offset) >= bestSq) continue;
      bestSq = lengthSq(offset);
      best = point - offset;
    }
    return best;
  }

  void add(const Vec3d& point, std::uint32_t cluster) {
    if (taken_.insert(cellOf(point)).second) added_.push_back({point, {cluster}});
  }

  const std::vector<ClusterSample>& samples_;
  const TriangleMesh& mesh_;
  const TriangleHierarchy& hierarchy_;
  const PlanarClusters& clusters_;
  double spacing_;
  std::set<Cell> taken_;
  std::vector<ClusterSample> added_;
};

}  // namespace

std::vector<ClusterSample> gapCrossingSamples(const VoronoiDiagram& diagram, const std::vector<ClusterSample>& samples,
                                              const TriangleMesh& mesh, const TriangleHierarchy& hierarchy,
                                              const PlanarClusters& clusters, double spacing) {
  Repair repair(samples, mesh, hierarchy, clusters, spacing);
  for (Face& face : boundedFaces(diagram)) repair.check(std::move(face));
  return repair.take();
}

}  // namespace cairn::builder
