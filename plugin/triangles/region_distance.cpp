// SPDX-License-Identifier: Zlib
#include "triangles/region_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "triangles/charge.h"

namespace cairn::bullet {

namespace {

constexpr float kNoDistance = std::numeric_limits<float>::infinity();

// How far all of the other triangle is from this one's plane, on one side of it; 0 if it is on both, or this one has no
// plane. In double: floats do not tell where the plane of a sliver is.
double besideBy(const Triangle& t, const Triangle& other) {
  const Vec3d from(t.a), out = cross(Vec3d(t.b) - from, Vec3d(t.c) - from);
  const double a = dot(out, Vec3d(other.a) - from), b = dot(out, Vec3d(other.b) - from),
               c = dot(out, Vec3d(other.c) - from);
  const double apart = std::max(std::min({a, b, c}), -std::max({a, b, c})), norm = length(out);
  return apart > 0 && norm > 0 ? apart / norm : 0;
}

}  // namespace

// How far triangles or ball of a leaf reach along a direction, whichever ends first.
float RegionDistance::extent(const PlacedTree& tree, NodeId leaf, const Vec3& direction) {
  const SphereTree& mesh = tree.tree();
  const Vec3 along = tree.axesFromPair() * direction;
  const Sphere ball = tree.sphere(leaf);
  float most = -kNoDistance;
  for (const std::uint32_t index : mesh.regionTriangles(leaf))
    for (const std::uint32_t v : mesh.triangles()[index]) most = std::max(most, dot(along, mesh.vertices()[v]));
  return std::min(most * tree.scale() + dot(direction, tree.toPair().translation),
                  dot(direction, ball.center) + ball.radius);
}

// Those that may come near the other leaf's ball. Returns how far the others are from it.
float RegionDistance::place(const PlacedTree& tree, NodeId leaf, const Sphere& other, float ofInterest,
                            std::vector<Bounded>& placed) {
  const Similarity& toPair = tree.toPair();
  const auto vertices = tree.tree().vertices();
  float others = kNoDistance;
  placed.clear();
  for (const std::uint32_t index : tree.tree().regionTriangles(leaf)) {
    const auto& [i, j, k] = tree.tree().triangles()[index];
    const Triangle t{toPair * vertices[i], toPair * vertices[j], toPair * vertices[k]};
    const Vec3 center = (t.a + t.b + t.c) * (1.0F / 3);
    const float radius = std::sqrt(std::max({lengthSq(t.a - center), lengthSq(t.b - center), lengthSq(t.c - center)}));
    const float apart = distance(center, other.center) - radius - other.radius;
    if (apart > ofInterest)
      others = std::min(others, apart);
    else
      placed.push_back({t, {center, radius}});
  }
  return others;
}

// Cheap bounds first, as far as they are enough.
float RegionDistance::between(const Bounded& t, const Bounded& u, float near, float ofInterest) {
  const float balls = distance(t.ball.center, u.ball.center) - t.ball.radius - u.ball.radius - near;
  if (balls > ofInterest) return balls;
  const double beside = std::max(besideBy(t.triangle, u.triangle), besideBy(u.triangle, t.triangle));
  if (beside > double(near) + double(ofInterest)) return static_cast<float>(beside) - near;
  if (trianglesCross(t.triangle, u.triangle)) return 0;
  const NearestPoints points = nearestOfTriangles(t.triangle, u.triangle);
  return std::max(0.0F, distance(points.onFirst, points.onSecond) - near);
}

std::optional<float> RegionDistance::atLeast(const PlacedTree& a, const PlacedTree& b, const NodePair& leaves,
                                             const Question& question, Budget& budget) {
  const std::size_t count = a.tree().regionTriangles(leaves.a).size() + b.tree().regionTriangles(leaves.b).size();
  if (!chargeFor(budget, kOverlapTestCost * count)) return {};
  const Sphere ballA = a.sphere(leaves.a), ballB = b.sphere(leaves.b);
  const float near =
      question.margins + kOverlapSlack * (ballA.radius + ballB.radius + distance(ballA.center, ballB.center));
  const float along = -extent(a, leaves.a, -question.normal) - extent(b, leaves.b, question.normal) - near;
  if (along > question.ofInterest) return along;
  if (!chargeFor(budget, kSphereUpdateCost * count)) return {};
  const float far = near + question.ofInterest;
  const float others = std::min(place(a, leaves.a, ballB, far, ofA_), place(b, leaves.b, ballA, far, ofB_));
  if (!chargeFor(budget, kOverlapTestCost * ofA_.size() * ofB_.size())) return {};
  float least = others - near;
  for (const Bounded& t : ofA_)
    for (const Bounded& u : ofB_) least = std::min(least, between(t, u, near, question.ofInterest));
  return std::max(least, std::max(0.0F, along));
}

}  // namespace cairn::bullet
