// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <optional>

#include "colliders/collider.h"
#include "contacts/contact.h"

struct btCollisionObjectWrapper;

namespace cairn::bullet {

/// The spheres around two whole sphere-trees, margins included; world axes, origin at the first body's.
struct RootSpheres {
  btVector3 centerA, centerB;
  btScalar radiusA = 0, radiusB = 0;
  btScalar lengths = 0;  ///< of what the centres were computed from, for rounding

  /// Whether they are so far apart that nothing can be within `maxSeparation` (world length), rounding included.
  bool areSeparated(btScalar maxSeparation) const;
  /// Whether neither is much larger than the other.
  bool areAlike() const;
  /// As a contact of the whole bodies; the pair frame is the spheres'.
  Contact contact() const;
};

/// Whether the spheres around two whole trees, or one such sphere and a static plane or a terrain, are certainly too
/// far apart for any contact, the speculative distance and `travel` (world length) included: then nothing else has to
/// be looked at. `roots`: those of two trees. Precondition: one of the shapes is a sphere-tree.
bool areRootsSeparated(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                       const std::optional<RootSpheres>& roots, btScalar travel);

/// Nothing unless both shapes are sphere-trees. Cheap.
std::optional<RootSpheres> rootSpheres(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);

}  // namespace cairn::bullet
