// SPDX-License-Identifier: Zlib
#include "cairn/core/surface_ray.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/traversal.h"

namespace cairn {

namespace {

// Of a unit vector along an axis: what is slower stays where it is.
constexpr float kMinSpeed = 1e-12F;

struct Ray {
  Vec3 origin, direction;
};

// Whether the ray passes the box before `nearest`. `slack`: what rounding may take from it. Boxes of nothing end before
// they begin.
bool passes(const Ray& ray, const Box& box, float slack, float nearest) {
  if (box.lower.x > box.upper.x) return false;
  float from = 0, to = nearest;
  for (int axis = 0; axis < 3; ++axis) {
    const float low = box.lower[axis] - slack - ray.origin[axis], high = box.upper[axis] + slack - ray.origin[axis];
    const float speed = ray.direction[axis];
    if (std::abs(speed) < kMinSpeed) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    from = std::max(from, std::min(low / speed, high / speed));
    to = std::min(to, std::max(low / speed, high / speed));
  }
  return from <= to;
}

void meet(const Ray& ray, const SurfaceFace& face, std::uint32_t triangle, SurfaceHit& hit) {
  const float speed = dot(face.normal, ray.direction);
  if (!(speed != 0)) return;
  const float way = (face.offset - dot(face.normal, ray.origin)) / speed;
  if (!(way >= 0 && way < hit.distance)) return;
  const Vec3 place = ray.origin + ray.direction * way;
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(face.inward[k], place) < face.inwardOffset[k]) return;
  hit = {triangle, way, speed > 0};
}

}  // namespace

SurfaceHit SurfaceRay::cast(const SurfaceView& surface, const Vec3& origin, const Vec3& direction,
                            std::uint32_t except) {
  const Ray ray{origin, direction};
  const SurfacePatches& patches = surface.patches();
  const std::span<const SurfaceFace> faces = surface.features().faces();
  const float slack = kOverlapSlack * length(patches.box().upper - patches.box().lower);
  SurfaceHit hit;
  waiting_.assign(1, 0);
  while (!waiting_.empty()) {
    const PatchFamily& family = patches.families()[waiting_.back()];
    waiting_.pop_back();
    for (std::uint32_t lane = 0; lane < PatchFamily::kWidth; ++lane) {
      if (!passes(ray, family.box(lane), slack, hit.distance)) continue;
      if (!family.isPatch(lane)) {
        waiting_.push_back(family.child[lane]);
        continue;
      }
      for (const std::uint32_t t : patches.patch(family.child[lane]).triangles)
        if (t != except) meet(ray, faces[t], t, hit);
    }
  }
  return hit;
}

// Directions that meshes seldom have edges in. A ray may slip through between two faces all the same, or graze an edge:
// of three the majority is right.
bool SurfaceRay::isInside(const SurfaceView& surface, const Vec3& point) {
  if (!surface.patches().box().holds(point)) return false;
  const auto saysSo = [&](const Vec3& direction) { return cast(surface, point, normalized(direction)).leaves; };
  const bool first = saysSo({0.5373F, 0.7011F, 0.4687F}), second = saysSo({-0.6113F, -0.2957F, 0.7341F});
  return first == second ? first : saysSo({0.3119F, -0.8231F, -0.4745F});
}

}  // namespace cairn
