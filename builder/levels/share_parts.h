// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Parents that hold all parts of a surface at the stand-off `limit`.
struct SharedParts {
  SphereSet parents;
  double limit = 0;
  /// By part: the parent that holds it, or the two that hold it together; none for a part without points.
  std::vector<std::vector<std::uint32_t>> parentsOf;
};

/// Moves parents by a random walk until they hold the parts of a surface at a low stand-off, with room for each part. A
/// part takes one of the `branching` places of a parent that holds it alone. Or it takes one place of each of two
/// parents that hold it together. A step moves one centre and is undone if a part loses its place. After each kept step
/// the limit is lowered as far as all parts keep theirs. `groupParts` stops where no whole part can change its parent.
/// The walk continues from there and ends some 20 % lower.
///
/// Cost: 6000 steps, each with a depth query, a pass over 40 points of each part and a bipartite matching. `lowest`:
/// the stand-off at which the walk stops. `start`: 1 to 8 balls. Precondition: all parts have room at some stand-off,
/// parts.size() <= start.size() * branching. Deterministic.
SharedParts shareParts(std::span<const PointSet> parts, const DepthField& field, SphereSet start, double lowest,
                       std::size_t branching, std::uint64_t seed);

}  // namespace cairn::builder
