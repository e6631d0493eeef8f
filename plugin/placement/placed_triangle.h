// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <cstdint>

#include "cairn/bullet/sphere_tree_shape.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

/// A source triangle in its body's frame. All callers get the same bits.
struct PlacedTriangle {
  PlacedTriangle(const SphereTreeShape& shape, std::uint32_t index) {
    const SphereTree& tree = shape.tree();
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = shape.bodyFromTree() * (toBullet(tree.vertices()[tree.triangles()[index][k]]) * shape.scale());
  }

  btVector3 corners[3];
};

}  // namespace cairn::bullet
