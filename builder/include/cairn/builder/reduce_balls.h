// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/medial_axis.h"

namespace cairn::builder {

/// The way a set of medial balls is reduced to a few (thesis 4.3 and 5.3).
enum class Reduction : std::uint8_t {
  hubbard,      ///< pairs of neighbours merged into Ritter's ball, least distance from the surface first (4.3)
  merge,        ///< pairs merged into the smallest ball, least stand-off first (5.3.1)
  burst,        ///< balls removed one after another, while their neighbours grow (5.3.2)
  expand,       ///< all balls grown to one stand-off; max-elim chooses the fewest that cover (5.3.3)
  expandCover,  ///< all balls grown to one stand-off; max-cover chooses the fewest that cover (5.3.3)
};

/// The reduction of `reduceBalls`, which refuses values out of range.
struct ReduceOptions {
  Reduction reduction = Reduction::merge;  ///< one of the constructions
  std::uint32_t count = 8;                 ///< largest number of balls, at least 1
  std::uint32_t surfacePieces = 5000;      ///< approximate number of surface pieces to be covered; 100..1e6
};

/// Reduces the medial balls of a whole solid to `count` or fewer, as in the thesis: centres do not move afterwards. The
/// reductions see the points `axis.surface`. Afterwards each uncovered part of the surface between them goes to the
/// ball that grows least for it. So the balls together cover the whole surface, by construction. Hubbard's reduction
/// starts from the inner balls alone, with neighbours and forming points from the diagram of `axis.samples`.
///
/// Max-elim sees all candidates and points and finds the stand-off by 20 bisections. A pure function. Fails for options
/// out of range and with `kCancelled`. Preconditions: `checkMesh(mesh)`; `axis` belongs to `mesh` and has a ball
/// inside.
///
///     MedialAxis axis = medialAxis(mesh, {}).value();
///     std::vector<Ball> balls = reduceBalls(mesh, axis, {.reduction = Reduction::expand, .count = 16}).value();
Result<std::vector<Ball>> reduceBalls(
    const TriangleMesh& mesh, const MedialAxis& axis, const ReduceOptions& options,
    const KeepGoing& keepGoing = [] { return true; });

}  // namespace cairn::builder
