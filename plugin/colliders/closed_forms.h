// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <optional>

#include "kernel/convex_body.h"

namespace cairn::bullet {

// Nearest points in the shape's frame, world lengths. Formulas are those of Ericson, *Real-Time Collision Detection*
// (2005), chapter 5; a point that is as near to several places gets one of them.

/// Of a box of these half extents and a sphere of this radius, both at the origin.
NearestPoint nearestOnBox(const Vec3& halfExtents, const Vec3& p);
NearestPoint nearestOnSphere(float radius, const Vec3& p);

/// Of capsules, cylinders and cones, their margin included, in the shape's frame: what turning a line, a rectangle or a
/// triangle around the shape's axis gives, grown by the margin. Nothing for other shapes.
std::optional<NearestPoint> nearestOnRound(const btConvexShape& shape, const Vec3& p);

/// Whether one of these answers.
bool isClosedForm(const btConvexShape& shape);

}  // namespace cairn::bullet
