// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btScalar.h>

#include "cairn/core/vec3.h"

class btCollisionObject;
struct btCollisionObjectWrapper;

namespace cairn::bullet {

/// Linear velocity, world axes, length per second. For objects that are not rigid bodies (a multibody's link, a ghost)
/// it is the last step's motion. It is zero for static rigid bodies, as in Bullet's solver.
Vec3 linearVelocity(const btCollisionObject& object);
/// Angular velocity, world axes, radians per second.
Vec3 angularVelocity(const btCollisionObject& object);

/// Estimate of the greatest closing speed of two surfaces, world length per second. `disc`: the first body's largest
/// distance from its origin, world length; the second body's rotation is counted up to there.
float closingSpeed(const btCollisionObject& first, const btCollisionObject& second, float disc);

/// How far two bodies, one of them a sphere-tree, may approach in `time` (seconds), world length. It is 0 unless one of
/// them moves far enough to ask for continuous collision detection (`setCcdMotionThreshold`, as for Bullet's own
/// shapes). A tree's rotation counts too.
float fastTravel(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, btScalar time);

/// How far two sphere-trees may approach in `time` if one of them is a shell with a wall thinner than `kTrustedDepth`
/// of its own size; at most `kMaxWalls` walls. It is 0 unless they may cross half of the wall: beyond that, the wall's
/// other side is nearer.
float wallTravel(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, btScalar time);

/// Bound on the speed of the first body's points in the second body's frame, which may rotate; world length per second.
/// `disc`: as in `closingSpeed`.
float speedInFrameOf(const btCollisionObject& second, const btCollisionObject& first, float disc);

/// Bound on the speed of the smaller body's points in the larger body's frame, world length per second.
float speedIn(const btCollisionObjectWrapper& larger, const btCollisionObjectWrapper& smaller);

/// Whether the body's place, or a moving body's velocity or force, is NaN or infinite. The solver would pass such
/// values on to everything that the body touches.
bool isNonFinite(const btCollisionObject& object);
/// Checks a body, or a part of one, at the place that the wrapper gives.
bool isNonFinite(const btCollisionObjectWrapper& body);

/// Reduced mass m0 m1 / (m0 + m1). It is the other body's mass where one body cannot move, and 0 where neither can. A
/// multibody's link counts as immovable, because its mass is not its own alone.
float reducedMass(const btCollisionObject& first, const btCollisionObject& second);

}  // namespace cairn::bullet
