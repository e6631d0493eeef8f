// SPDX-License-Identifier: Zlib
#include "node_barrier.h"

#include <cmath>

namespace cairn::soft {

namespace {

/// Whether the box around the way, grown by `margin`, meets the mesh's. False for a way that is not finite.
bool isNear(const Box& box, const Vec3& from, const Vec3& to, float margin) {
  for (int axis = 0; axis < 3; ++axis) {
    const float low = from[axis] < to[axis] ? from[axis] : to[axis],
                high = from[axis] < to[axis] ? to[axis] : from[axis];
    if (!(low - margin <= box.upper[axis] && high + margin >= box.lower[axis])) return false;
  }
  return true;
}

NodeBarrier nearestBarrier(const SurfaceView& surface, const SurfaceDepth& nearest) {
  const double distance = length(nearest.away);
  const double side = nearest.depth > 0 ? -1 : 1;
  const Vec3 normal =
      distance > 0 ? Vec3(nearest.away * (side / distance)) : surface.features().faces()[nearest.triangle].normal;
  return {normal, static_cast<float>(side * distance)};
}

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
                                                   float margin, std::uint32_t& guess) {
  if (!isNear(surface.patches().box(), from, to, margin)) return {};
  const SurfaceDepth nearest = depth_.at(surface, to, guess);
  guess = nearest.triangle;
  // A way shorter than the distance from its end to the surface cannot have met it.
  if (lengthSq(Vec3d(to) - Vec3d(from)) >= lengthSq(nearest.away))
    if (const std::optional<NodeBarrier> barrier = entered(surface, from, to)) return barrier;
  const NodeBarrier barrier = nearestBarrier(surface, nearest);
  if (!(barrier.separation < margin)) return {};
  return barrier;
}

}  // namespace cairn::soft
