// SPDX-License-Identifier: Zlib
#include "node_barrier.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/traversal.h"

namespace cairn::soft {

namespace {

/// Whether the box around the way, grown by `margin`, meets the mesh's. False for a way that is not finite.
bool isNear(const Box& box, const Vec3& from, const Vec3& to, float margin) {
  for (int axis = 0; axis < 3; ++axis) {
    const float low = from[axis] < to[axis] ? from[axis] : to[axis];
    const float high = from[axis] < to[axis] ? to[axis] : from[axis];
    if (!(low - margin <= box.upper[axis] && high + margin >= box.lower[axis])) return false;
  }
  return true;
}

/// What rounding may take from distances near the mesh.
float slackOf(const Box& box) {
  return kOverlapSlack * (length(box.lower) + length(box.upper));
}

NodeBarrier nearestBarrier(const SurfaceView& surface, const SurfaceDepth& nearest) {
  const double distance = length(nearest.away);
  const double side = nearest.depth > 0 ? -1 : 1;
  const Vec3 normal =
      distance > 0 ? Vec3(nearest.away * (side / distance)) : surface.features().faces()[nearest.triangle].normal;
  return {normal, static_cast<float>(side * distance)};
}

/// The sides from a triangle's first corner, and its normal; the normal is zero where there is no area.
struct TriangleFrame {
  Vec3d corner, first, second, normal;

  TriangleFrame(const SurfaceView& surface, std::uint32_t triangle) {
    const std::array<std::uint32_t, 3>& t = surface.triangles[triangle];
    corner = Vec3d(surface.vertices[t[0]]);
    first = Vec3d(surface.vertices[t[1]]) - corner;
    second = Vec3d(surface.vertices[t[2]]) - corner;
    const Vec3d area = cross(first, second);
    normal = lengthSq(area) > 0 ? normalized(area) : Vec3d();
  }
};

}  // namespace

std::optional<NodeBarrier> NodeBarrierSearch::entered(const SurfaceView& surface, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const float length = std::sqrt(lengthSq(way));
  if (!(length > 0)) return {};
  const SurfaceHit hit = ray_.cast(surface, from, way * (1 / length));
  if (hit.triangle == SurfaceHit::kNone || hit.leaves || hit.distance > length) return {};
  const SurfaceFace& face = surface.features().faces()[hit.triangle];
  return NodeBarrier{face.normal, dot(face.normal, to) - face.offset};
}

std::optional<NodeBarrier> NodeBarrierSearch::find(const SurfaceView& surface, const Vec3& from, const Vec3& to,
                                                   float margin, NodeTrack& track) {
  const Box& box = surface.patches().box();
  if (!isNear(box, from, to, margin)) return {};
  const float way = length(to - from);
  // The distance falls by no more than the node has gone since; a way shorter than it cannot have met the surface.
  if (track.clearance - length(to - track.place) > std::max(margin, way) + slackOf(box)) return {};
  const SurfaceDepth nearest = depth_.at(surface, to, track.triangle);
  const NodeBarrier barrier = nearestBarrier(surface, nearest);
  track = {nearest.triangle, to, std::max(barrier.separation, 0.0F)};
  if (way + slackOf(box) >= std::abs(barrier.separation))
    if (const std::optional<NodeBarrier> face = entered(surface, from, to)) return face;
  if (!(barrier.separation < margin)) return {};
  return barrier;
}

Vec3 carried(const Vec3& point, const SurfaceView& first, const SurfaceView& second, std::uint32_t triangle) {
  const TriangleFrame before(first, triangle), after(second, triangle);
  const Vec3d to = Vec3d(point) - before.corner;
  const double height = dot(to, before.normal);
  const Vec3d within = to - before.normal * height;
  const double areaSq = lengthSq(cross(before.first, before.second));
  if (!(areaSq > 0) || lengthSq(after.normal) == 0) return point;
  const double u = dot(cross(within, before.second), cross(before.first, before.second)) / areaSq;
  const double v = dot(cross(before.first, within), cross(before.first, before.second)) / areaSq;
  return Vec3(after.corner + after.first * u + after.second * v + after.normal * height);
}

}  // namespace cairn::soft
