// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "contacts/contact.h"
#include "placement/placed_tree.h"

namespace cairn::bullet {

/// Borders between leaves that are no edges of the body. Where a flat face is cut into leaves, a shape that has sunk in
/// beside a leaf is nearest to the leaf's border and would be pushed aside along the face. A contact is of such a
/// border where another, no less deep, is along the normal of a face that its leaf has too, and its leaf reaches no
/// farther than that face. At most four faces are kept.
class InnerEdges {
 public:
  /// `tolerance`: world length within which depths and planes are one. The tree must outlive this.
  InnerEdges(const PlacedTree& tree, float tolerance) : tree_(tree), tolerance_(tolerance) {}

  /// Learns the face that a contact is along the normal of, if there is one.
  void note(const Contact& contact);
  /// The normal, from the collider to the tree, along which a contact of an inner border would have to be; nothing
  /// for all others.
  const Vec3* normalInstead(const Contact& contact) const;

 private:
  struct Face {
    Vec3 normal, point;
    float separation = 0;
  };
  bool hasFace(NodeId leaf, const Vec3& normal, float cosine) const;

  const PlacedTree& tree_;
  float tolerance_;
  std::array<Face, 4> faces_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
