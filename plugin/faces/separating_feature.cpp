// SPDX-License-Identifier: Zlib
#include "faces/separating_feature.h"
#include "faces/edge_limits.h"
#include "placement/unit_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::bullet {

namespace {

constexpr float kSameFacingCosine = 0.999961923F;  // half a degree
constexpr float kLastCosine = 0.99862953F;         // 3 degrees
constexpr float kSameDirection = 1e-6F;            // one less the cosine

// A few directions, no two the same.
class Directions {
 public:
  std::span<const Vec3> all() const { return std::span(directions_).first(count_); }

  // `isLine`: opposite ones are the same.
  void add(const Vec3& direction, bool isLine) {
    if (lengthSq(direction) == 0 || count_ == directions_.size()) return;
    for (const Vec3& d : all()) {
      const float cosine = dot(d, direction);
      if ((isLine ? std::abs(cosine) : cosine) > 1 - kSameDirection) return;
    }
    directions_[count_++] = direction;
  }

 private:
  std::array<Vec3, 3 * PlacedMesh::kMaxTriangles> directions_;
  std::size_t count_ = 0;
};

Directions facesOf(const SphereTree& tree) {
  Directions faces;
  for (std::size_t t = 0; t < tree.triangles().size(); ++t) faces.add(PlacedMesh::outwards(tree, t), false);
  return faces;
}

bool hasDirectedEdge(const std::array<std::uint32_t, 3>& triangle, std::uint32_t from, std::uint32_t to) {
  for (std::size_t k = 0; k < 3; ++k)
    if (triangle[k] == from && triangle[(k + 1) % 3] == to) return true;
  return false;
}

// Where a triangle's neighbour lies in its plane there is no edge.
bool isInsideFace(const SphereTree& tree, std::size_t triangle, std::uint32_t from, std::uint32_t to) {
  for (std::size_t t = 0; t < tree.triangles().size(); ++t)
    if (hasDirectedEdge(tree.triangles()[t], to, from))
      return dot(PlacedMesh::outwards(tree, t), PlacedMesh::outwards(tree, triangle)) > kSameFacingCosine;
  return false;
}

Directions edgesOf(const SphereTree& tree) {
  Directions edges;
  for (std::size_t t = 0; t < tree.triangles().size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = tree.triangles()[t][k], to = tree.triangles()[t][(k + 1) % 3];
      const Vec3 along = tree.vertices()[to] - tree.vertices()[from];
      if (from < to && along != Vec3() && !isInsideFace(tree, t, from, to)) edges.add(unitVector(along), true);
    }
  return edges;
}

std::optional<SeparatingFeature> faceAlong(const PlacedTree& a, const PlacedTree& b, const Vec3& normal) {
  std::optional<SeparatingFeature> best;
  float nearest = kSameFacingCosine;
  for (const bool isOfA : {true, false}) {
    const PlacedTree& tree = isOfA ? a : b;
    const Vec3 wanted = tree.axesFromPair() * (isOfA ? -normal : normal);
    for (std::size_t t = 0; t < tree.tree().triangles().size(); ++t) {
      const Vec3 out = PlacedMesh::outwards(tree.tree(), t);
      if (dot(out, wanted) <= nearest) continue;
      nearest = dot(out, wanted);
      best = isOfA ? SeparatingFeature{out, {}} : SeparatingFeature{{}, out};
    }
  }
  return best;
}

std::optional<SeparatingFeature> edgesAlong(const PlacedTree& a, const PlacedTree& b, const Vec3& normal) {
  const Directions edgesA = edgesOf(a.tree()), edgesB = edgesOf(b.tree());
  std::optional<SeparatingFeature> best;
  float nearest = kSameFacingCosine;
  for (const Vec3& ofA : edgesA.all())
    for (const Vec3& ofB : edgesB.all()) {
      const float cosine = dot(SeparatingFeature{ofA, ofB}.normal(a, b), normal);
      if (std::abs(cosine) <= nearest) continue;
      nearest = std::abs(cosine);
      best = SeparatingFeature{cosine > 0 ? ofA : -ofA, ofB};
    }
  return best;
}

}  // namespace

Vec3 SeparatingFeature::normal(const PlacedTree& a, const PlacedTree& b) const {
  const Vec3 placedA = transpose(a.axesFromPair()) * ofA, placedB = transpose(b.axesFromPair()) * ofB;
  if (lengthSq(ofA) == 0) return placedB;
  if (lengthSq(ofB) == 0) return -placedA;
  const Vec3 across = cross(placedA, placedB);
  const float sine = length(across);
  return sine > kParallelEdges ? across / sine : Vec3();
}

std::optional<SeparatingFeature> featureAlong(const PlacedTree& a, const PlacedTree& b, const Vec3& normal) {
  const std::optional<SeparatingFeature> face = faceAlong(a, b, normal);
  return face ? face : edgesAlong(a, b, normal);
}

Separation bestSeparation(const PlacedTree& a, const PlacedTree& b, const PlacedMesh& meshA, const PlacedMesh& meshB,
                          std::span<const Vec3> lasts, float lastBonus, float enough, bool hasPreferences) {
  Separation best;
  float bestMerit = -std::numeric_limits<float>::max();
  const auto offer = [&](const SeparatingFeature& feature, float bonus) {
    const Vec3 normal = feature.normal(a, b);
    if (lengthSq(normal) == 0) return;
    const float gap = meshA.lowest(normal) + meshB.lowest(-normal);
    const bool isLast = std::ranges::any_of(lasts, [&](const Vec3& last) { return dot(last, normal) > kLastCosine; });
    const float merit = hasPreferences ? gap + bonus + (isLast ? lastBonus : 0) : gap;
    if (merit <= bestMerit) return;
    bestMerit = merit;
    best = {feature, gap};
  };
  const float faceBonus = kFaceFraction * (meshA.radius() + meshB.radius());
  const Directions facesA = facesOf(a.tree()), facesB = facesOf(b.tree());
  for (const Vec3& face : facesA.all()) offer({face, {}}, faceBonus);
  for (const Vec3& face : facesB.all()) offer({{}, face}, faceBonus);
  if (best.gap >= enough) return best;
  const Directions edgesA = edgesOf(a.tree()), edgesB = edgesOf(b.tree());
  if (edgesA.all().size() * edgesB.all().size() > kMaxEdgePairs) return best;
  for (const Vec3& ofA : edgesA.all())
    for (const Vec3& ofB : edgesB.all()) {
      offer({ofA, ofB}, 0);
      offer({-ofA, ofB}, 0);
    }
  return best;
}

}  // namespace cairn::bullet
