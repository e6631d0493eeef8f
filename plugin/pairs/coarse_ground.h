// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btScalar.h>

#include <array>
#include <span>

#include "cairn/core/sphere_tree.h"
#include "contacts/contact.h"

struct btCollisionObjectWrapper;

namespace cairn::bullet {

/// A fallback for a body on a terrain or a static plane that the budget did not reach: one contact for each child of
/// the root. Each contact is a point of the body above the triangle below it, so it is true; other contacts may be
/// missing.
class CoarseGround {
 public:
  /// Finds the contacts, nearest first. Every node is tried whose sphere comes within `maxSeparation` (world length) of
  /// the plane of the triangle below its centre. Its contact is the region's extreme point against that plane's normal,
  /// if that point is within `maxSeparation` of the ground. The pair frame is the tree's. Cost: two triangles and
  /// sixteen points a node; no allocation. Precondition: one body is a tree, the other a terrain or a static plane.
  CoarseGround(const btCollisionObjectWrapper& tree, const btCollisionObjectWrapper& ground, btScalar maxSeparation);

  std::span<Contact> contacts() { return std::span(contacts_).first(count_); }

 private:
  std::array<Contact, kFamilyWidth> contacts_;
  std::size_t count_ = 0;
};

/// Whether a tree is certainly farther above a terrain than the contact distance and `travel` (world length) together.
/// Constant time. Precondition: one body is a tree, the other a terrain.
bool isClearOfGround(const btCollisionObjectWrapper& tree, const btCollisionObjectWrapper& ground, btScalar travel);

}  // namespace cairn::bullet
