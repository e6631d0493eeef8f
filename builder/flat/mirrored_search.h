// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "balls/sphere_set.h"
#include "cairn/builder/progress.h"
#include "flat/mirror.h"

namespace cairn::builder {

/// A set with a mirror plane: one ball of each pair, and those on the plane.
struct MirroredSet {
  SphereSet pairs, onPlane;

  /// Each ball of a pair followed by its image, then those on the plane.
  SphereSet expanded(const Mirror& mirror) const;
};

/// Points of a surface folded to the positive side of its mirror plane, to be covered.
struct MirroredProblem {
  const PointSet& points;
  const DepthField& field;  ///< mirrored too, or nearly
  const Mirror& mirror;
  std::size_t pairs = 0, onPlane = 0;
  double enough = 0;  ///< stand-off not worth lowering
  const KeepGoing& keepGoing;
};

/// Lowers the worst stand-off as `optimiseLevel` does, with exactly so many pairs and balls on the plane. For a ball on
/// the plane its points and their images count: their farthest distance is least on the plane, so going back to it
/// after a step costs nothing. Idle balls go where the cover is worst. Deterministic.
MirroredSet mirroredSearch(const MirroredProblem& problem, MirroredSet start);

}  // namespace cairn::builder
