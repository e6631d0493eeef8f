// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "queries/leaf_balls.h"

namespace cairn::bullet {

/// Reports where the ray enters the balls of leaves; the part is the leaf's level, the index its `NodeId`. A ray that
/// begins inside a ball does not enter it. Backfaces are never visible, so no flag matters.
void castRayAtBalls(const SphereTreeShape& shape, const LeafBalls& balls, btTriangleRaycastCallback& callback);

/// Reports where the callback's convex shape meets the balls of leaves, by Bullet's cast of two convex shapes.
/// `reportHit` and the return value: see `castConvex`.
bool castConvexAtBalls(const SphereTreeShape& shape, const LeafBalls& balls, btTriangleConvexcastCallback& callback);

}  // namespace cairn::bullet
