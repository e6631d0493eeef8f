// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btScalar.h>

#include <array>
#include <span>

#include "cairn/core/sphere_tree.h"
#include "contacts/contact.h"

struct btCollisionObjectWrapper;

namespace cairn::bullet {

/// What stands in for a body on a terrain or a static plane that nobody has time to look at closely: one point of each
/// of the root's children. Each is a point of the body over the triangle below it, so that what it says is true; what
/// is left out is what other points would say.
class CoarseGround {
 public:
  /// Finds them, nearest first: of each node whose sphere comes within `maxSeparation` (world length) of the plane of
  /// the triangle below its centre, the extreme point of its region against that plane's normal, if it is within
  /// `maxSeparation` of the ground below it. The pair frame is the tree's. Cost: two triangles and sixteen points a
  /// node; no allocation. Precondition: a tree and a terrain or a static plane.
  CoarseGround(const btCollisionObjectWrapper& tree, const btCollisionObjectWrapper& ground, btScalar maxSeparation);

  std::span<Contact> contacts() { return std::span(contacts_).first(count_); }

 private:
  std::array<Contact, kFamilyWidth> contacts_;
  std::size_t count_ = 0;
};

/// Whether a whole tree is certainly farther above a terrain than contacts are looked for, `travel` (world length)
/// included. Constant time. Precondition: a tree and a terrain.
bool isClearOfGround(const btCollisionObjectWrapper& tree, const btCollisionObjectWrapper& ground, btScalar travel);

}  // namespace cairn::bullet
