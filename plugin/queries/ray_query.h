// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "queries/region_balls.h"

namespace cairn::bullet {

/// Gives the callback every source triangle it could accept, near ones first, and stops where its `m_hitFraction` says
/// so. What a hit is, remains the callback's own business: culling, normals, reports. Each triangle once.
void castRay(const SphereTreeShape& shape, const RegionBalls& regions, btTriangleRaycastCallback& callback);

}  // namespace cairn::bullet
