// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btScalar.h>

#include "cairn/core/vec3.h"

class btCollisionObject;
struct btCollisionObjectWrapper;

namespace cairn::bullet {

/// World axes, length per second. What is no rigid body (a multibody's link, a ghost) says how it moved, not how it
/// moves; zero of a static rigid body, whose speed Bullet's solver does not look at either.
Vec3 linearVelocity(const btCollisionObject& object);
/// World axes, radians per second.
Vec3 angularVelocity(const btCollisionObject& object);

/// About how fast the surfaces of two bodies approach at most, world length per second: the second's turning counts as
/// far as the first reaches. `disc`: that far, from its origin, world length.
float closingSpeed(const btCollisionObject& first, const btCollisionObject& second, float disc);

/// How far two bodies, one of them a sphere-tree, may come nearer to each other in so much time, world length, if that
/// is so far that one of them asks for continuous collision detection (`setCcdMotionThreshold`, as with Bullet's own
/// shapes; a tree's turning counts too); else 0.
float fastTravel(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, btScalar time);

/// The same of two sphere-trees of which one is a shell, its wall thinner than `kTrustedDepth` of its size, if they may
/// come so far in that time that they cross half of the wall: from there on its other side is nearer. Else 0.
float wallTravel(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, btScalar time);

/// Bound on how fast points of the first body move in the frame of the second, which may turn; world length
/// per second. `disc`: as above.
float speedInFrameOf(const btCollisionObject& second, const btCollisionObject& first, float disc);

/// The same of a whole body in the frame of a larger one.
float speedIn(const btCollisionObjectWrapper& larger, const btCollisionObjectWrapper& smaller);

/// Whether its place, or, of a body that moves, its speeds or the forces on it are no number or endless: the solver
/// would hand that on to whatever it touches.
bool isNonFinite(const btCollisionObject& object);
/// The same of a body, or of a part of one, that stands elsewhere.
bool isNonFinite(const btCollisionObjectWrapper& body);

/// m0 m1 / (m0 + m1); that of the other where one cannot be moved, 0 where neither can. A multibody's link, whose mass
/// is not its own alone, counts as held fast.
float reducedMass(const btCollisionObject& first, const btCollisionObject& second);

}  // namespace cairn::bullet
