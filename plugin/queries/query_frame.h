// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

/// By how much, in the tree's unit, Bullet's tests of triangles and our own of nodes can differ by rounding alone.
/// `farthest`: the largest coordinate that takes part, in the world's unit.
double roundingSlack(const SphereTreeShape& shape, double farthest);

}  // namespace cairn::bullet
