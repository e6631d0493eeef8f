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
  /// By part: the parent that holds it, or the two that do so together; none for a part without points.
  std::vector<std::vector<std::uint32_t>> parentsOf;
};

/// Moves parents until they hold the parts of a surface at as low a stand-off as a random walk finds, with room for
/// each: a part takes one of the `branching` places of a parent that holds it alone, or one of each of two that hold it
/// between them. A step moves one centre and is undone if a part loses its place; whenever it is kept, the limit is
/// lowered as far as all parts keep theirs. Alternating, as `groupParts` does, stops where no whole part can change
/// hands; the walk goes on from there and ends some 20 % lower.
///
/// 6000 steps of a depth query, a pass over 40 points of each part and a bipartite matching. `lowest`: where to stop.
/// `start`: 1 to 8 balls; precondition: room for all parts at some stand-off, parts.size() <= start.size() * branching.
/// Deterministic.
SharedParts shareParts(std::span<const PointSet> parts, const DepthField& field, SphereSet start, double lowest,
                       std::size_t branching, std::uint64_t seed);

}  // namespace cairn::builder
