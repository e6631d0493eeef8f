// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <optional>

#include "colliders/collider.h"
#include "contacts/contact.h"

struct btCollisionObjectWrapper;

namespace cairn::bullet {

/// The root spheres of two trees, margins included; world axes, origin at the first body.
struct RootSpheres {
  btVector3 centerA, centerB;
  btScalar radiusA = 0, radiusB = 0;
  btScalar lengths = 0;  ///< sum of the lengths that the centres were computed from, for rounding

  /// Whether the spheres are certainly farther apart than `maxSeparation` (world length), rounding included.
  bool areSeparated(btScalar maxSeparation) const;
  /// Whether their radii are similar, within `kMaxSizeRatio`.
  bool areAlike() const;
  /// The contact of the two spheres, in their own frame.
  Contact contact() const;
};

/// Whether the root spheres of two trees, or of a tree and a plane or terrain, are certainly too far apart for any
/// contact. The speculative distance and `travel` (world length) are included. `roots`: those of two trees.
/// Precondition: one shape is a sphere-tree.
bool areRootsSeparated(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                       const std::optional<RootSpheres>& roots, btScalar travel);

/// The root spheres of two trees; nothing if a shape is no tree. Cheap.
std::optional<RootSpheres> rootSpheres(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);

}  // namespace cairn::bullet
