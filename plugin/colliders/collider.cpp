// SPDX-License-Identifier: Zlib
#include "colliders/collider.h"

#include <algorithm>
#include <limits>

namespace cairn::bullet {

Vec3 Collider::alignNormals(std::span<Contact> /*cluster*/, std::span<const Vec3> /*lasts*/,
                            std::vector<Contact>& /*outliers*/) {
  return {};
}

std::optional<float> Collider::appendOfMesh(const MeshQuery& /*question*/, std::vector<Contact>& /*contacts*/) {
  return std::nullopt;
}

void Collider::appendContacts(std::span<const NodePair> pairs, std::span<float> separations,
                              std::vector<Contact>& contacts) {
  std::fill(separations.begin(), separations.end(), -std::numeric_limits<float>::infinity());
  appendContacts(pairs, contacts);
}

}  // namespace cairn::bullet
