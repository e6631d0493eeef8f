// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

class LeafBalls;
class RegionBalls;

/// Serves a ray or convex sweep of Bullet's along its path, and returns true; returns false for other callbacks.
/// Without it, Bullet would ask a shape of unknown kind for all triangles in the box around the whole path. Hits the
/// `balls` if there are any, else the triangles. Needs run-time type information across Bullet's library, which
/// Bullet's virtual tables provide.
bool answerCast(const SphereTreeShape& shape, const RegionBalls& regions, const LeafBalls* balls,
                btTriangleCallback& callback);

}  // namespace cairn::bullet
