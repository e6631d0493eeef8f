// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "cairn/core/vec3.h"
#include "contacts/relative_motion.h"
#include "pairs/pair_sides.h"
#include "pairs/root_spheres.h"
#include "placement/pair_placement.h"

namespace cairn::bullet {

/// Sizes of a pair's bodies, and the separations up to which contacts are wanted.
struct PairSizes {
  float smaller = 0;        ///< size of the smaller body, world length
  float speculative = 0;    ///< contact distance without a query's threshold, world length
  float reported = 0;       ///< with the query's threshold; all contacts below this are wanted, world length
  float maxSeparation = 0;  ///< contacts below this are wanted where the surfaces meet soon, world length
  bool treeIsSmaller = true;

  /// `otherSize`: 0 for a body without a size, such as a point. `threshold`, `ahead`: how far beyond the speculative
  /// distance a query wants contacts, and fast bodies near thin walls need them; world lengths.
  static PairSizes of(const SphereTreeShape& tree, float otherSize, btScalar threshold, float ahead);
  /// A length as a fraction of the smaller body's size.
  double fraction(float length) const { return double(length / smaller); }
};

/// The poses of a pair's bodies and how they move.
struct PairMotion {
  RelativeMotion relative;           ///< when the pair was last begun
  RelativePlacement seenAt;          ///< when a step last looked at the pair
  RelativePlacement seenNow;         ///< in this step, if the pair was estimated
  std::optional<RootSpheres> roots;  ///< of two trees, in this step
  btVector3 origin{0, 0, 0};         ///< of the pair frame, in the world: the tree body's origin
  Vec3d center;                      ///< of the smaller body, world frame
  float closingSpeed = 0, reducedMass = 0;

  static RelativePlacement placementOf(const PairSides& sides);
  /// Bound on the speed of the tree in the other body's frame, world length per second.
  static float speedInOther(const PairSides& sides);

  /// Moves the pair frame to the bodies' present poses.
  PairPlacement place(const PairSides& sides, const PairSizes& sizes);
  /// Moves the pair frame for contacts that only follow their bodies; a body counts as being at its origin.
  void follow(const PairSides& sides, const PairSizes& sizes);
  /// Precondition of the next two functions: the pair frame is at the present poses.
  void set(const PairSides& sides, const PairSizes& sizes, btScalar timeStep);
  void setVelocities(const PairSides& sides, btScalar timeStep);
  /// Whether the bodies moved farther since the last look than their speed explains: the user has placed them
  /// elsewhere.
  bool areSetDown(const RelativePlacement& now, const PairSides& sides, const PairSizes& sizes,
                  btScalar timeStep) const;
};

}  // namespace cairn::bullet
