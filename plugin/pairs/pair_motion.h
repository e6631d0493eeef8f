// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "cairn/core/vec3.h"
#include "contacts/relative_motion.h"
#include "pairs/pair_sides.h"
#include "pairs/root_spheres.h"
#include "placement/pair_placement.h"

namespace cairn::bullet {

/// How large the bodies of a pair are, and how far apart they still touch.
struct PairSizes {
  float smaller = 0;        ///< of the smaller body, world length
  float speculative = 0;    ///< contacts nearer than this are wanted whatever a query asks for
  float maxSeparation = 0;  ///< contacts with a gap below this are wanted
  bool treeIsSmaller = true;

  /// `otherSize`: 0 of what has none; a point has none to speak of. `threshold`: how far beyond the speculative
  /// distance contacts are wanted, world length.
  static PairSizes of(const SphereTreeShape& tree, float otherSize, btScalar threshold);
  /// A length as a fraction of the smaller body's size.
  double fraction(float length) const { return double(length / smaller); }
};

/// Where the bodies of a pair are and how they move.
struct PairMotion {
  RelativeMotion relative;           ///< when the pair was last begun
  RelativePlacement seenAt;          ///< when a step last looked at it
  RelativePlacement seenNow;         ///< in this step, if it was surveyed
  std::optional<RootSpheres> roots;  ///< of two trees, in this step
  btVector3 origin{0, 0, 0};         ///< of the pair frame, in the world: the tree body's
  Vec3d center;                      ///< of the smaller body, world frame
  float closingSpeed = 0, reducedMass = 0;

  static RelativePlacement placementOf(const PairSides& sides);
  /// Bound on how fast the tree moves in the other's frame, world length per second.
  static float speedInOther(const PairSides& sides);

  /// Takes the pair frame to where the bodies are.
  PairPlacement place(const PairSides& sides, const PairSizes& sizes);
  /// The same of what only follows the bodies: a body is where its origin is.
  void follow(const PairSides& sides, const PairSizes& sizes);
  /// Precondition of both: the pair frame is where the bodies are.
  void set(const PairSides& sides, const PairSizes& sizes, btScalar timeStep);
  void setVelocities(const PairSides& sides, btScalar timeStep);
  /// Whether the bodies moved farther since they were seen than their speed explains: they were set down.
  bool areSetDown(const RelativePlacement& now, const PairSides& sides, const PairSizes& sizes,
                  btScalar timeStep) const;
};

}  // namespace cairn::bullet
