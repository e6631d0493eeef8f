// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

struct btCollisionObjectWrapper;

namespace cairn::bullet {

/// The motion of a body's shape within a step if nothing stops it, as Bullet will integrate it, with the step's forces.
///
///     const Trajectory trajectory(wrapper, timeStep);
///     const btTransform atEnd = trajectory.at(1);
class Trajectory {
 public:
  /// `body`: wraps an object, or a child of a compound that moves with it. A sphere always has the world's axes: its
  /// rotation does not change its shape. In the axes of a rolling sphere, things beside it would move on arcs.
  /// `timeStep`: seconds.
  Trajectory(const btCollisionObjectWrapper& body, btScalar timeStep);

  /// The shape's pose after this fraction of the step, 0 to 1; world frame.
  btTransform at(btScalar fraction) const;
  /// The trajectory without its velocity against `normal` (unit, world frame) relative to `other`.
  Trajectory along(const btVector3& normal, const Trajectory& other) const;
  /// Rotation in the whole step, in radians; 0 for a sphere about its centre.
  btScalar turn() const;

 private:
  btTransform object_, childInObject_;
  btVector3 linear_, angular_;
  btScalar timeStep_;
  bool isRound_;
};

}  // namespace cairn::bullet
