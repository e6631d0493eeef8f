// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "cairn/core/sphere_tree.h"

namespace cairn::bullet {

/// A tree's spheres as a hierarchy over the *balls* of its leaves.
///
/// A node's sphere holds its region of the surface, but the balls of its leaves may stick out of it: whoever asks for
/// the balls needs other radii on the way to them. Here each inner node's reaches around all of its leaves' balls.
class LeafBalls {
 public:
  /// Linear in leaves times depth. The tree must outlive this.
  explicit LeafBalls(const SphereTree& tree);

  /// With the centres, lanes and index of the tree's own.
  const Family& family(std::uint32_t index) const { return families_[index]; }
  /// Bytes it holds.
  std::size_t memoryBytes() const { return sizeof *this + families_.capacity() * sizeof(Family); }

 private:
  std::vector<Family> families_;
};

}  // namespace cairn::bullet
