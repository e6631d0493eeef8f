// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "queries/region_balls.h"

namespace cairn::bullet {

/// Casts the callback's convex shape at the source triangles on its path, near ones first, and reports hits to the
/// callback. Triangles are tested by Bullet's own test. A return value of `reportHit` that equals the reported fraction
/// ends the search beyond it; Bullet itself ignores that value. Returns false, and does nothing, for a shape that
/// rotates without moving.
bool castConvex(const SphereTreeShape& shape, const RegionBalls& regions, btTriangleConvexcastCallback& callback);

}  // namespace cairn::bullet
