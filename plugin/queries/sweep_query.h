// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "queries/region_balls.h"

namespace cairn::bullet {

/// Casts the callback's convex shape at the source triangles it can meet on its way, near ones first, by Bullet's own
/// test of a triangle, and reports to the callback. What `reportHit` returns counts only where it is the fraction just
/// reported, which is how a callback says that it wants nothing farther; Bullet does not look at it at all. False, and
/// nothing is done, where the shape turns without moving.
bool castConvex(const SphereTreeShape& shape, const RegionBalls& regions, btTriangleConvexcastCallback& callback);

}  // namespace cairn::bullet
