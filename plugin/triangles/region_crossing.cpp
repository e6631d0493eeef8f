// SPDX-License-Identifier: Zlib
#include "triangles/region_crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::bullet {

namespace {

// Whether all of the other triangle is more than `near` away from this one's plane, on one side.
bool isBeside(const Triangle& t, const Triangle& other, float near) {
  const Vec3 out = cross(t.b - t.a, t.c - t.a);
  const float a = dot(out, other.a - t.a), b = dot(out, other.b - t.a), c = dot(out, other.c - t.a);
  const float least = near * length(out);
  return std::min({a, b, c}) > least || std::max({a, b, c}) < -least;
}

}  // namespace

// How far triangles or ball of a leaf reach along a direction, whichever ends first.
float RegionCrossing::extent(const PlacedTree& tree, NodeId leaf, const Vec3& direction) {
  const SphereTree& mesh = tree.tree();
  const Vec3 along = tree.axesFromPair() * direction;
  const Sphere ball = tree.sphere(leaf);
  float most = -std::numeric_limits<float>::infinity();
  for (const std::uint32_t index : mesh.regionTriangles(leaf))
    for (const std::uint32_t v : mesh.triangles()[index]) most = std::max(most, dot(along, mesh.vertices()[v]));
  return std::min(most * tree.scale() + dot(direction, tree.toPair().translation),
                  dot(direction, ball.center) + ball.radius);
}

// Those that come near the other leaf's ball.
void RegionCrossing::place(const PlacedTree& tree, NodeId leaf, const Sphere& within, std::vector<Bounded>& placed) {
  const Similarity& toPair = tree.toPair();
  const auto vertices = tree.tree().vertices();
  placed.clear();
  for (const std::uint32_t index : tree.tree().regionTriangles(leaf)) {
    const auto& [i, j, k] = tree.tree().triangles()[index];
    const Triangle t{toPair * vertices[i], toPair * vertices[j], toPair * vertices[k]};
    const Vec3 center = (t.a + t.b + t.c) * (1.0F / 3);
    const float radiusSq = std::max({lengthSq(t.a - center), lengthSq(t.b - center), lengthSq(t.c - center)});
    const float reach = within.radius + std::sqrt(radiusSq);
    if (lengthSq(center - within.center) <= reach * reach) placed.push_back({t, {center, std::sqrt(radiusSq)}});
  }
}

bool RegionCrossing::meet(const Bounded& t, const Bounded& u, float margins) {
  const float centers = distance(t.ball.center, u.ball.center), radii = t.ball.radius + u.ball.radius;
  const float near = margins + kOverlapSlack * (radii + centers);
  if (centers - radii > near) return false;
  if (isBeside(t.triangle, u.triangle, near) || isBeside(u.triangle, t.triangle, near)) return false;
  if (trianglesCross(t.triangle, u.triangle)) return true;
  const NearestPoints points = nearestOfTriangles(t.triangle, u.triangle);
  return distance(points.onFirst, points.onSecond) <= near;
}

std::optional<bool> RegionCrossing::between(const PlacedTree& a, const PlacedTree& b, const NodePair& leaves,
                                            const Vec3& normal, float margins, Budget& budget) {
  const std::size_t ofA = a.tree().regionTriangles(leaves.a).size(), ofB = b.tree().regionTriangles(leaves.b).size();
  if (!budget.charge(static_cast<std::uint32_t>(kOverlapTestCost * (ofA + ofB)))) return {};
  const float apart = -extent(a, leaves.a, -normal) - extent(b, leaves.b, normal);
  const Sphere ballA = a.sphere(leaves.a), ballB = b.sphere(leaves.b);
  const float near = margins + kOverlapSlack * (ballA.radius + ballB.radius + distance(ballA.center, ballB.center));
  if (apart > near) return false;
  if (!budget.charge(static_cast<std::uint32_t>(kSphereUpdateCost * (ofA + ofB)))) return {};
  place(a, leaves.a, {ballB.center, ballB.radius + near}, ofA_);
  place(b, leaves.b, {ballA.center, ballA.radius + near}, ofB_);
  if (!budget.charge(static_cast<std::uint32_t>(kOverlapTestCost * ofA_.size() * ofB_.size()))) return {};
  return std::ranges::any_of(ofA_, [&](const Bounded& t) {
    return std::ranges::any_of(ofB_, [&](const Bounded& u) { return meet(t, u, margins); });
  });
}

}  // namespace cairn::bullet
