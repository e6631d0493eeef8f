// SPDX-License-Identifier: Zlib
#include "cairn/core/surface_ray.h"

#include "cairn/core/tree_surface.h"

namespace cairn {

namespace {

struct Ray {
  Vec3 origin, direction;
};

// Whether the ray passes the ball before `nearest`.
bool passes(const Ray& ray, const Sphere& ball, float nearest) {
  const Vec3 to = ball.center - ray.origin;
  const float along = dot(to, ray.direction);
  if (along < -ball.radius || along > nearest + ball.radius) return false;
  return lengthSq(to - ray.direction * along) <= ball.radius * ball.radius * (1 + kOverlapSlack);
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

SurfaceHit SurfaceRay::cast(const SphereTree& tree, const Vec3& origin, const Vec3& direction, std::uint32_t except) {
  const Ray ray{origin, direction};
  const std::span<const SurfaceFace> faces = tree.surface().features.faces();
  SurfaceHit hit;
  stack_.assign(1, kRootNode);
  while (!stack_.empty()) {
    const NodeId node = stack_.back();
    stack_.pop_back();
    if (!passes(ray, tree.sphere(node), hit.distance)) continue;
    if (tree.isLeaf(node)) {
      for (const std::uint32_t t : tree.regionTriangles(node))
        if (t != except) meet(ray, faces[t], t, hit);
      continue;
    }
    const std::uint32_t family = tree.childFamily(node);
    for (std::uint32_t lane = 0; lane < tree.familySize(family); ++lane) stack_.push_back(family * kFamilyWidth + lane);
  }
  return hit;
}

// A direction that meshes seldom have edges in.
bool SurfaceRay::isInside(const SphereTree& tree, const Vec3& point) {
  return cast(tree, point, normalized(Vec3(0.5373F, 0.7011F, 0.4687F))).leaves;
}

}  // namespace cairn
