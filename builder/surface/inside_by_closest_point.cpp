// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/inside_by_closest_point.h"

#include <algorithm>

#include "surface/edges.h"
#include "surface/infinity.h"

namespace cairn::builder {
namespace {

using Voxel = TriangleGrid::Voxel;

/// Visits voxels whose index differs from `home` by `ring` along some axis and by no more along any, clipped to the
/// grid.
template <class Visit>
void forRing(const TriangleGrid& grid, const Voxel& home, std::uint32_t ring, const Visit& visit) {
  Voxel from, to, v;
  for (int axis = 0; axis < 3; ++axis) {
    from[axis] = home[axis] - std::min(home[axis], ring);
    to[axis] = std::min(home[axis] + ring, grid.size()[axis] - 1);
  }
  const auto apart = [&](int axis) { return v[axis] > home[axis] ? v[axis] - home[axis] : home[axis] - v[axis]; };
  for (v[2] = from[2]; v[2] <= to[2]; ++v[2])
    for (v[1] = from[1]; v[1] <= to[1]; ++v[1]) {
      const bool whole = apart(2) == ring || apart(1) == ring;
      for (v[0] = from[0]; v[0] <= to[0]; ++v[0]) {
        if (whole || apart(0) == ring) visit(v);
      }
    }
}

/// Distance from a point to a voxel, squared.
double distanceSq(const TriangleGrid& grid, const Voxel& voxel, const Vec3d& point) {
  const Vec3d offset = point - grid.centerOf(voxel);
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = std::max(std::abs(offset[axis]) - grid.voxelEdge() / 2, 0.0);
    sum += gap * gap;
  }
  return sum;
}

}  // namespace

InsideByClosestPoint::InsideByClosestPoint(const TriangleMesh& mesh, std::uint32_t perSide)
    : mesh_(mesh),
      grid_(mesh, perSide),
      packets_(mesh.triangles.size() / TrianglePacket::kWidth + 1),
      normals_(mesh.triangles.size()),
      neighbours_(mesh.triangles.size()),
      firstAround_(mesh.vertices.size() + 1, 0),
      trianglesAround_(3 * mesh.triangles.size()) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = mesh.corners(t);
    packets_[t / TrianglePacket::kWidth].set(t % TrianglePacket::kWidth, t, c);
    normals_[t] = normalized(cross(c[1] - c[0], c[2] - c[0]));
    for (const std::uint32_t vertex : mesh.triangles[t]) ++firstAround_[vertex + 1];
  }
  for (std::size_t v = 1; v < firstAround_.size(); ++v) firstAround_[v] += firstAround_[v - 1];
  std::vector<std::uint32_t> next(firstAround_.begin(), firstAround_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t vertex : mesh.triangles[t]) trianglesAround_[next[vertex]++] = t;
  // A closed mesh has two triangles at every edge; sorting puts them side by side.
  const std::vector<HalfEdge> halves = sortedHalfEdges(mesh);
  for (std::size_t i = 0; i + 1 < halves.size(); i += 2) {
    neighbours_[halves[i].triangle][halves[i].side] = halves[i + 1].triangle;
    neighbours_[halves[i + 1].triangle][halves[i + 1].side] = halves[i].triangle;
  }
}

InsideByClosestPoint::Nearest InsideByClosestPoint::nearest(const Vec3d& point) const {
  const Voxel home = grid_.voxelOf(point);
  const std::uint32_t rings = std::max({grid_.size()[0], grid_.size()[1], grid_.size()[2]});
  // Voxels beyond `ring` rings are farther than the distance to the point's own voxel by at least this.
  const double outside = std::sqrt(distanceSq(grid_, home, point));
  const double toOwnFaces = grid_.voxelEdge() / 2 - [&] {
    const Vec3d offset = point - grid_.centerOf(home);
    return std::min(std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)}), grid_.voxelEdge() / 2);
  }();
  Nearest best;
  double bestSq = kInfinity;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const double reach = std::max(outside, ring == 0 ? 0.0 : toOwnFaces + (ring - 1) * grid_.voxelEdge());
    if (reach * reach > bestSq) break;
    forRing(grid_, home, ring, [&](const Voxel& voxel) {
      if (distanceSq(grid_, voxel, point) > bestSq) return;
      for (const std::uint32_t t : grid_.trianglesIn(voxel)) {
        const TrianglePacket::Nearest place =
            packets_[t / TrianglePacket::kWidth].nearest(t % TrianglePacket::kWidth, point);
        if (const double d = lengthSq(place.offset); d < bestSq) bestSq = d, best = {t, place};
      }
    });
  }
  return best;
}

bool InsideByClosestPoint::isBehindEdge(std::uint32_t triangle, int edge, const Vec3d& offset) const {
  const std::uint32_t other = neighbours_[triangle][edge];
  // Concave when the neighbour rises above this face's plane.
  const Vec3d& onEdge = mesh_.vertices[mesh_.triangles[triangle][edge]];
  double rise = 0;
  for (const Vec3d& corner : mesh_.corners(other)) {
    const double height = dot(corner - onEdge, normals_[triangle]);
    if (std::abs(height) > std::abs(rise)) rise = height;
  }
  const bool here = isBehind(triangle, offset), there = isBehind(other, offset);
  return rise > 0 ? here || there : here && there;
}

bool InsideByClosestPoint::isBehindCorner(std::uint32_t vertex, const Vec3d& offset) const {
  return std::all_of(trianglesAround_.begin() + firstAround_[vertex],
                     trianglesAround_.begin() + firstAround_[vertex + 1],
                     [&](std::uint32_t t) { return isBehind(t, offset); });
}

bool InsideByClosestPoint::inside(const Vec3d& point) const {
  if (!grid_.holds(point)) return false;
  const Nearest found = nearest(point);
  const Vec3d& offset = found.place.offset;
  switch (found.place.feature) {
    case Feature::corner0:
    case Feature::corner1:
    case Feature::corner2:
      return isBehindCorner(mesh_.triangles[found.triangle][static_cast<int>(found.place.feature)], offset);
    case Feature::edge0:
    case Feature::edge1:
    case Feature::edge2:
      return isBehindEdge(found.triangle, static_cast<int>(found.place.feature) - static_cast<int>(Feature::edge0),
                          offset);
    case Feature::face:
      break;
  }
  return isBehind(found.triangle, offset);
}

}  // namespace cairn::builder
