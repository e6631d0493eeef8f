// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <optional>

#include "kernel/convex_body.h"

namespace cairn::bullet {

// Nearest points of simple shapes, in the shape's frame, world lengths; constant time. The formulas are those of
// Ericson, *Real-Time Collision Detection* (2005), chapter 5. A point that is equally near to several places gets one
// of them.
//
//     const NearestPoint nearest = nearestOnBox(halfExtents, p);  // nearest.distance < 0 inside

/// For a box of these half extents, or a sphere of this radius, at the origin.
NearestPoint nearestOnBox(const Vec3& halfExtents, const Vec3& p);
NearestPoint nearestOnSphere(float radius, const Vec3& p);

/// For capsules, cylinders and cones, margin included: a line, a rectangle or a triangle rotated around the shape's
/// axis and grown by the margin. Empty for other shapes.
std::optional<NearestPoint> nearestOnRound(const btConvexShape& shape, const Vec3& p);

/// Whether one of the functions above handles the shape.
bool isClosedForm(const btConvexShape& shape);

}  // namespace cairn::bullet
