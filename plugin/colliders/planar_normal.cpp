// SPDX-License-Identifier: Zlib
#include "colliders/planar_normal.h"

#include <algorithm>
#include <array>
#include <limits>

#include "contacts/normal_clusters.h"

namespace cairn::bullet {

namespace {

// Sine of the angle below which two edges are parallel and have no common normal.
constexpr float kParallelEdges = 0.1F;
// Fraction of the size. A face is preferred to a pair of edges that separates better by less than this: the
// cross product of nearly parallel edges is meaningless.
constexpr float kFaceFraction = 0.001F;

constexpr float kSameCandidateCosine = 0.99862953F;  // 3 degrees: one candidate stands for both
constexpr float kTowardsCosine = 0.173648178F;       // 80 degrees: tilted centre lines may belong to a face
constexpr float kHysteresisFraction = 0.003F;
// Numbers of contacts, the deepest first, whose faces and whose edges become candidates.
constexpr std::size_t kMaxFaceContacts = 16;
constexpr std::size_t kMaxEdgeContacts = 4;

std::span<const Contact> deepest(std::span<const Contact> cluster, std::size_t maxCount) {
  return cluster.first(std::min(cluster.size(), maxCount));
}

float flatWeight(const PlacedTree& a, const PlacedTree& b, const Contact& c) {
  if (c.ofSpheres) return 0;
  return 0.5F * static_cast<float>(a.isFaceted(c.pair.a)) + 0.5F * static_cast<float>(b.isFaceted(c.pair.b));
}

bool isFlat(const PlacedTree& a, const PlacedTree& b, std::span<const Contact> cluster) {
  float flat = 0;
  for (const Contact& c : cluster) flat += flatWeight(a, b, c);
  return 2 * flat >= static_cast<float>(cluster.size());
}

// The smallest separation along the normal, or the first one found below `enough`. A contact counts only where the
// normal belongs to both regions, because only there are their extreme points those of the bodies. Minus infinity where
// no contact counts.
float deepestAlong(const PlacedTree& a, const PlacedTree& b, float margins, std::span<const Contact> cluster,
                   const Vec3& normal, float enough) {
  constexpr float kNone = std::numeric_limits<float>::max();
  float smallestSeparation = kNone;
  for (const Contact& c : cluster) {
    if (c.ofSpheres) continue;
    const float separation = isSameNormal(c.normal, normal)
                                 ? c.separation
                                 : dot(normal, a.support(c.pair.a, -normal) - b.support(c.pair.b, normal)) - margins;
    if (separation >= smallestSeparation || !a.faces(c.pair.a, -normal) || !b.faces(c.pair.b, normal)) continue;
    smallestSeparation = separation;
    if (smallestSeparation < enough) break;
  }
  return smallestSeparation == kNone ? -kNone : smallestSeparation;
}

// The directions of a leaf's edges, where two of its faces meet; pair frame, not of unit length.
struct Edges {
  std::array<Vec3, kMaxFaceNormals> direction;
  std::size_t count = 0;

  Edges(const PlacedTree& tree, NodeId node) {
    if (!tree.isFaceted(node)) return;
    const std::span<const Vec3> faces = tree.tree().faceNormals(node);
    const Mat3 pairFromAxes = transpose(tree.axesFromPair());
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (std::size_t j = i + 1; j < faces.size(); ++j) {
        const Vec3 along = cross(faces[i], faces[j]);  // zero for the two sides of a plate
        if (lengthSq(along) > kParallelEdges * kParallelEdges) direction[count++] = pairFromAxes * along;
      }
  }
};

}  // namespace

bool PlanarNormal::add(const Vec3& normal, const Vec3& towards, std::size_t maxCount) {
  if (dot(normal, towards) < kTowardsCosine || candidates_.size() >= maxCount) return false;
  for (const Candidate& c : candidates_)
    if (dot(c.normal, normal) > kSameCandidateCosine) return false;
  candidates_.push_back({normal, 0});
  return true;
}

// Face normals point outwards, so A's are reversed. The larger body's faces come first, because of two similar
// candidates the first is kept. Along a small face's normal, a large face would be as deep as it is wide times the
// tilt.
void PlanarNormal::collectFacesOfBoth(const PlacedTree& a, const PlacedTree& b, const Contact& contact) {
  const bool isLargerFirst = a.sphere(kRootNode).radius >= b.sphere(kRootNode).radius;
  if (isLargerFirst) collectFaces(a, contact.pair.a, -1, contact.normal);
  collectFaces(b, contact.pair.b, 1, contact.normal);
  if (!isLargerFirst) collectFaces(a, contact.pair.a, -1, contact.normal);
}

void PlanarNormal::collectFaces(const PlacedTree& tree, NodeId node, float side, const Vec3& towards) {
  if (!tree.isFaceted(node)) return;
  const Mat3 pairFromAxes = transpose(tree.axesFromPair());
  for (const Vec3& n : tree.tree().faceNormals(node)) add((pairFromAxes * n) * side, towards, kMaxFaces);
}

void PlanarNormal::collectEdges(const PlacedTree& a, const PlacedTree& b, const Contact& contact) {
  const Edges ofA(a, contact.pair.a), ofB(b, contact.pair.b);
  for (std::size_t i = 0; i < ofA.count; ++i)
    for (std::size_t j = 0; j < ofB.count; ++j) {
      const Vec3 both = cross(ofA.direction[i], ofB.direction[j]);
      const float sine = length(both);
      if (sine * sine < kParallelEdges * kParallelEdges * lengthSq(ofA.direction[i]) * lengthSq(ofB.direction[j]))
        continue;
      const Vec3 normal = both / sine;
      add(dot(normal, contact.normal) < 0 ? -normal : normal, contact.normal, kMaxCandidates);
    }
}

// The likeliest candidates come first, so that others are soon given up.
void PlanarNormal::putLastFirst(std::span<const Vec3> lasts, float bonus) {
  auto first = candidates_.begin();
  for (auto it = candidates_.begin(); it != candidates_.end(); ++it) {
    if (!std::ranges::any_of(lasts, [&](const Vec3& last) { return dot(last, it->normal) > kSameCandidateCosine; }))
      continue;
    it->bonus += bonus;
    std::rotate(first, it, it + 1);
    ++first;
  }
}

bool PlanarNormal::isFartherAlongOther(const PlacedTree& a, const PlacedTree& b, float margins, const Contact& contact,
                                       float minSeparation) {
  candidates_.clear();
  collectFacesOfBoth(a, b, contact);
  collectEdges(a, b, contact);
  return std::ranges::any_of(candidates_, [&](const Candidate& candidate) {
    return deepestAlong(a, b, margins, std::span(&contact, 1), candidate.normal, minSeparation) > minSeparation;
  });
}

Vec3 PlanarNormal::find(const PlacedTree& a, const PlacedTree& b, float margins, std::span<const Contact> cluster,
                        std::span<const Vec3> lasts) {
  if (cluster.empty() || !isFlat(a, b, cluster)) return {};
  candidates_.clear();
  for (const Contact& c : deepest(cluster, kMaxFaceContacts)) {
    if (c.ofSpheres) continue;
    collectFacesOfBoth(a, b, c);
  }
  const float size = a.sphere(kRootNode).radius + b.sphere(kRootNode).radius;
  for (Candidate& face : candidates_) face.bonus = kFaceFraction * size;
  for (const Contact& c : deepest(cluster, kMaxEdgeContacts)) {
    if (c.ofSpheres) continue;
    collectEdges(a, b, c);
    // A smooth body may lie on an edge.
    if (a.isFaceted(c.pair.a) != b.isFaceted(c.pair.b)) add(c.normal, c.normal, kMaxCandidates);
  }

  putLastFirst(lasts, kHysteresisFraction * size);
  Vec3 best;
  float bestMerit = -0.5F * size;  // deeper than any two regions
  for (const Candidate& candidate : candidates_) {
    const float separation = deepestAlong(a, b, margins, cluster, candidate.normal, bestMerit - candidate.bonus);
    if (separation + candidate.bonus <= bestMerit) continue;
    best = candidate.normal;
    bestMerit = separation + candidate.bonus;
  }
  return best;
}

}  // namespace cairn::bullet
