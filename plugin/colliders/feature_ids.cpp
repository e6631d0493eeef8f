// SPDX-License-Identifier: Zlib
#include "colliders/feature_ids.h"

#include <algorithm>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

namespace {

struct Parts {
  int ofA, ofB;
};

Parts partsOf(FeatureKind kind) {
  constexpr int kVertex = static_cast<int>(ContactPart::vertex), kFace = static_cast<int>(ContactPart::face),
                kEdge = static_cast<int>(ContactPart::edge);
  switch (kind) {
    case FeatureKind::vertexOnFace:
      return {kVertex, kFace};
    case FeatureKind::faceOnVertex:
      return {kFace, kVertex};
    case FeatureKind::edgeOnEdge:
      return {kEdge, kEdge};
    case FeatureKind::deepVertexOfA:
      return {kVertex, -1};
    case FeatureKind::deepVertexOfB:
      return {-1, kVertex};
    case FeatureKind::deepEdgeOfA:
      return {kEdge, kFace};
    case FeatureKind::deepEdgeOfB:
      return {kFace, kEdge};
  }
  return {-1, -1};
}

}  // namespace

ContactId featureIdsOf(const FeatureContact& contact) {
  const Parts parts = partsOf(contact.kind);
  const auto index = [](int part, std::uint32_t feature) { return part < 0 ? -1 : static_cast<int>(feature); };
  return {parts.ofA, index(parts.ofA, contact.featureA), parts.ofB, index(parts.ofB, contact.featureB)};
}

Contact contactOf(const FeatureContact& found, const ContactId& id) {
  Contact contact;
  contact.position = found.position;
  contact.normal = found.normal;
  contact.separation = found.separation;
  contact.id = id;
  contact.isExact = true;
  contact.exactError = std::max(0.0F, -found.separation);
  return contact;
}

}  // namespace cairn::bullet
