// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "cairn/core/sphere_tree.h"

namespace cairn::bullet {

/// A tree's spheres as a hierarchy over the *balls* of its leaves. A node's sphere holds its region of the surface, but
/// its leaves' balls may stick out of it. So a query for balls needs other radii on its way down. Here each inner
/// node's sphere holds the balls of all its leaves.
///
///     const LeafBalls balls(tree);
///     castRayAtBalls(shape, balls, callback);
class LeafBalls {
 public:
  /// The tree must outlive this object. Cost: linear in leaves times depth.
  explicit LeafBalls(const SphereTree& tree);

  /// Like the tree's family of this index, with the same lanes and the centres of the nodes' spheres.
  const Family& family(std::uint32_t index) const { return families_[index]; }
  /// Bytes this object holds.
  std::size_t memoryBytes() const { return sizeof *this + families_.capacity() * sizeof(Family); }

 private:
  std::vector<Family> families_;
};

}  // namespace cairn::bullet
