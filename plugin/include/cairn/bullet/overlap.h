// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <optional>

#include "cairn/core/export.h"

class btCollisionObject;
class btCollisionShape;
class btCollisionWorld;
class btTransform;

namespace cairn::bullet {

/// What a body would be inside of, world frame.
struct Overlap {
  const btCollisionObject* with = nullptr;  ///< of several the one it is deepest in
  btScalar depth = 0;                       ///< m, of the deepest contact; > 0
  btVector3 direction{0, 0, 0};             ///< unit: the contact gets shallower along it
  int count = 0;                            ///< how many it overlaps
};

/// The deepest overlap of `shape` at `pose` with the objects of a world, or nothing where the place is free. Use it
/// before you spawn a body. Overlaps up to `tolerance` (m) do not count. Surfaces are compared: a body wholly inside a
/// hollow one overlaps nothing. Ghosts and other objects without contact response do not count. `mask`: Bullet's filter
/// bits; objects whose group is in it count. Trees need a world whose dispatcher knows them. Cost: one full
/// `contactTest`, whatever the budget. Do not call it during a step.
CAIRN_BULLET_EXPORT std::optional<Overlap> overlapAt(btCollisionWorld& world, btCollisionShape& shape,
                                                     const btTransform& pose, btScalar tolerance = 0, int mask = -1);

/// Limits of `separate`.
struct SeparationLimits {
  btScalar tolerance = btScalar(0.005);  ///< allowed overlap, as a fraction of the smaller body's box
  int passes = 200;                      ///< greatest number of passes over all overlapping pairs
};

/// The outcome of `separate`.
struct Separation {
  int passes = 0;      ///< passes made
  int overlaps = 0;    ///< pairs that overlapped before
  int left = 0;        ///< pairs that still overlap; 0 unless bodies have no room or passes were too few
  btScalar moved = 0;  ///< m: the largest displacement of a body
};

/// Moves dynamic bodies apart that were placed inside each other, without giving them any speed. Steps cannot do that
/// for concave bodies: rings that pass through each other push back as long as they are linked. Both bodies of a pair
/// move, static and kinematic ones never. They move along their contact while it is shallow, else from centre to
/// centre, until their boxes are apart. Call it before the first step. Velocities stay, and motion states get the new
/// poses. The result has the same bits on every run. Cost of a pass: a full `contactPairTest` for each pair of boxes
/// that overlap.
CAIRN_BULLET_EXPORT Separation separate(btCollisionWorld& world, const SeparationLimits& limits = {});

}  // namespace cairn::bullet
