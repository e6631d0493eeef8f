// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

class LeafBalls;
class RegionBalls;

/// Bullet asks a shape of unknown kind for all triangles in the box around a whole ray or sweep. Where the callback is
/// one of Bullet's two casts, it is answered along its way instead, by the `balls` if there are any, and this returns
/// true. Needs run-time type
/// information across Bullet's library, which Bullet's own virtual tables bring along.
bool answerCast(const SphereTreeShape& shape, const RegionBalls& regions, const LeafBalls* balls,
                btTriangleCallback& callback);

}  // namespace cairn::bullet
