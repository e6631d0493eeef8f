// SPDX-License-Identifier: Zlib
#include "counterparts/planar_normal.h"

#include <algorithm>
#include <limits>

#include "contacts/normal_clusters.h"

namespace cairn::bullet {

namespace {

constexpr float kSameNormalCosine = 0.99862953F;  // 3 degrees: one candidate stands for both
constexpr float kHysteresisFraction = 0.003F;

float flatWeight(const PlacedTree& a, const PlacedTree& b, const Contact& c) {
  if (c.ofSpheres) return 0;
  return 0.5F * static_cast<float>(a.isPlanar(c.pair.a)) + 0.5F * static_cast<float>(b.isPlanar(c.pair.b));
}

bool isFlat(const PlacedTree& a, const PlacedTree& b, std::span<const Contact> cluster) {
  float flat = 0;
  for (const Contact& c : cluster) flat += flatWeight(a, b, c);
  return 2 * flat >= static_cast<float>(cluster.size());
}

float deepestAlong(const PlacedTree& a, const PlacedTree& b, std::span<const Contact> cluster, const Vec3& normal) {
  float smallestGap = std::numeric_limits<float>::max();
  for (const Contact& c : cluster)
    if (!c.ofSpheres)
      smallestGap = std::min(smallestGap, dot(normal, a.support(c.pair.a, -normal) - b.support(c.pair.b, normal)));
  return smallestGap;
}

}  // namespace

void PlanarNormal::addCandidate(const Vec3& normal, const Vec3& towards) {
  if (dot(normal, towards) < kClusterCosine || candidates_.size() == kMaxCandidates) return;
  for (const Vec3& c : candidates_)
    if (dot(c, normal) > kSameNormalCosine) return;
  candidates_.push_back(normal);
}

// Face normals point outwards: B's towards A as they are, A's reversed.
void PlanarNormal::collect(const PlacedTree& tree, NodeId node, float side, const Vec3& towards, bool ofPlanar) {
  if (tree.isPlanar(node) != ofPlanar) return;
  const Mat3 pairFromAxes = transpose(tree.axesFromPair());
  for (const Vec3& n : tree.tree().faceNormals(node)) addCandidate((pairFromAxes * n) * side, towards);
}

Vec3 PlanarNormal::find(const PlacedTree& a, const PlacedTree& b, std::span<const Contact> cluster, const Vec3& last) {
  if (cluster.empty() || !isFlat(a, b, cluster)) return {};
  candidates_.clear();
  const bool lastFits = dot(last, cluster[0].normal) >= kClusterCosine;
  if (lastFits) candidates_.push_back(last);
  for (const bool ofPlanar : {true, false})
    for (const Contact& c : cluster) {
      if (c.ofSpheres) continue;
      collect(a, c.pair.a, -1, c.normal, ofPlanar);
      collect(b, c.pair.b, 1, c.normal, ofPlanar);
    }

  const float size = a.sphere(kRootNode).radius + b.sphere(kRootNode).radius;
  Vec3 best;
  float bestGap = std::numeric_limits<float>::lowest();
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const bool isLast = i == 0 && lastFits;
    const float gap = deepestAlong(a, b, cluster, candidates_[i]) + (isLast ? kHysteresisFraction * size : 0);
    if (gap > bestGap) {
      best = candidates_[i];
      bestGap = gap;
    }
  }
  return best;
}

}  // namespace cairn::bullet
