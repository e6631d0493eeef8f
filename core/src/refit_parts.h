// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/sphere_tree.h"

namespace cairn {

/// A place on a triangle that stays there when its corners move: first + (second - first) * b + (third - first) * c.
struct FixedPlace {
  std::uint32_t triangle = 0;
  double b = 0, c = 0;
};

/// Parts of triangles, given to leaves.
///
///     const std::vector<std::vector<FixedPlace>> corners = cornersOfParts(tree);
///
/// Returns for each record the corners of what its leaves were given: of each triangle the convex hull's, triangles
/// ascending. Precondition: every triangle is listed by a leaf.
std::vector<std::vector<FixedPlace>> cornersOfParts(const SphereTree& tree);

/// The first triangle that no leaf lists; their number if there is none.
std::uint32_t firstUnlisted(const SphereTree& tree);

}  // namespace cairn
