// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "queries/region_balls.h"

namespace cairn::bullet {

/// Gives the callback every source triangle that it could accept, near ones first, each once. Stops where the
/// callback's `m_hitFraction` says so. The callback itself decides hits: culling, normals, reports.
void castRay(const SphereTreeShape& shape, const RegionBalls& regions, btTriangleRaycastCallback& callback);

}  // namespace cairn::bullet
