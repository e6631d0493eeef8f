// SPDX-License-Identifier: Zlib
#include "colliders/inner_edges.h"

#include <algorithm>

#include "contacts/face_limits.h"

namespace cairn::bullet {

namespace {

// Cosine of the half degree within which contacts have one normal.
constexpr float kAlongNormalCosine = 0.99996192F;

}  // namespace

void InnerEdges::note(const Contact& contact) {
  if (!hasFace(contact.pair.a, contact.normal, kAlongNormalCosine)) return;
  for (Face& face : std::span(faces_).first(count_)) {
    if (dot(face.normal, contact.normal) < kAlongNormalCosine) continue;
    if (contact.separation < face.separation) face = {contact.normal, contact.onTree(), contact.separation};
    return;
  }
  if (count_ < faces_.size()) faces_[count_++] = {contact.normal, contact.onTree(), contact.separation};
}

const Vec3* InnerEdges::normalInstead(const Contact& contact) const {
  const NodeId leaf = contact.pair.a;
  const auto hides = [&](const Face& face) {
    return dot(face.normal, contact.normal) < kAlongNormalCosine &&
           face.separation <= contact.separation + tolerance_ && hasFace(leaf, face.normal, kSameFaceCosine) &&
           dot(face.normal, tree_.support(leaf, -face.normal) - face.point) >= -tolerance_;
  };
  const auto kept = std::span(faces_).first(count_);
  const auto found = std::ranges::find_if(kept, hides);
  return found == kept.end() ? nullptr : &found->normal;
}

bool InnerEdges::hasFace(NodeId leaf, const Vec3& normal, float cosine) const {
  const Vec3 outwards = -(tree_.axesFromPair() * normal);
  return std::ranges::any_of(tree_.tree().faceNormals(leaf),
                             [&](const Vec3& face) { return dot(face, outwards) > cosine; });
}

}  // namespace cairn::bullet
