// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

struct btCollisionObjectWrapper;

namespace cairn::bullet {

/// How a body's shape moves within a step if nothing stops it: as Bullet will integrate it, the step's forces included.
class Trajectory {
 public:
  /// `body`: of an object, or of a child of a compound, which moves with it. A sphere has the world's axes all the
  /// time: it looks the same from everywhere, and what stands beside one that rolls would else move on arcs.
  /// `timeStep`: seconds.
  Trajectory(const btCollisionObjectWrapper& body, btScalar timeStep);

  /// Where the shape stands after this part of the step, 0 to 1; world frame.
  btTransform at(btScalar fraction) const;
  /// The same without what moves it against `normal` (unit, world frame) faster than `other`.
  Trajectory along(const btVector3& normal, const Trajectory& other) const;
  /// Radians within the whole step; 0 of a sphere about its middle, which looks the same.
  btScalar turn() const;

 private:
  btTransform object_, childInObject_;
  btVector3 linear_, angular_;
  btScalar timeStep_;
  bool isRound_;
};

}  // namespace cairn::bullet
