// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/builder/medial_axis.h"

namespace cairn::builder {

/// How a set of medial balls is reduced to a few (thesis 4.3 and 5.3).
enum class Reduction : std::uint8_t {
  hubbard,      ///< pairs of neighbours merged into Ritter's ball, least distance from the surface first (4.3)
  merge,        ///< pairs merged into the smallest ball, least stand-off first (5.3.1)
  burst,        ///< one removed after another, its neighbours growing (5.3.2)
  expand,       ///< all grown to one stand-off, the fewest that cover chosen by max-elim (5.3.3)
  expandCover,  ///< the same by max-cover
};

/// To how many balls `reduceBalls` goes, and how. Values out of range are refused by it.
struct ReduceOptions {
  Reduction reduction = Reduction::merge;  ///< which construction
  std::uint32_t count = 8;                 ///< balls at most, at least 1
  std::uint32_t surfacePieces = 5000;      ///< of the surface to be covered, about; 100..1e6
};

/// The medial balls of a whole solid reduced to `count` or fewer, as the thesis has it: centres are not moved
/// afterwards. The reductions see the points `axis.surface`; then what no ball holds of the surface between them goes
/// to the ball that has to grow least for it, so that together they cover the whole surface, by construction. Hubbard's
/// starts from the inner balls alone, with neighbours and forming points as in the diagram of `axis.samples`.
///
/// Max-elim sees all candidates and points and finds the stand-off by 20 bisections. A pure function. Fails for options
/// out of range and with `kCancelled`. Preconditions: `checkMesh(mesh)`; `axis` is of `mesh` and has a ball inside.
Result<std::vector<Ball>> reduceBalls(
    const TriangleMesh& mesh, const MedialAxis& axis, const ReduceOptions& options,
    const KeepGoing& keepGoing = [] { return true; });

}  // namespace cairn::builder
