// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "contacts/contact.h"
#include "placement/placed_tree.h"

namespace cairn::bullet {

/// Detects contacts at borders between leaves that are no edges of the body. Where a flat face is cut into leaves, a
/// shape that has sunk in beside a leaf is nearest to the leaf's border. Its contact would push the shape along the
/// face.
///
///     InnerEdges edges(tree, tolerance);
///     for (const Contact& contact : contacts) edges.note(contact);
///     if (const Vec3* normal = edges.normalInstead(contact)) measureAlong(*normal);
///
/// A contact is at such a border under three conditions. Another contact is at least as deep, along the normal of a
/// face. The leaf of the first contact has that face too. The leaf reaches no farther than that face. At most four
/// faces are kept.
class InnerEdges {
 public:
  /// `tolerance`: world length within which depths and planes are equal. The tree must outlive this object.
  InnerEdges(const PlacedTree& tree, float tolerance) : tree_(tree), tolerance_(tolerance) {}

  /// Keeps the contact's face, if its normal is that of a face.
  void note(const Contact& contact);
  /// The normal, from the collider to the tree, that replaces a contact's own at an inner border; null for all other
  /// contacts.
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
