// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "balls/sphere_set.h"
#include "cairn/builder/progress.h"

namespace cairn::builder {

/// What a relocation works on.
struct RelocationProblem {
  const PointSet& points;  ///< of the whole surface
  const DepthField& field;
  std::size_t count = 8;     ///< most balls
  double enough = 0;         ///< stand-off not worth lowering
  std::size_t attempts = 0;  ///< optimisations of a few balls, in all
  const KeepGoing& keepGoing;
};

/// Second chances for a flat set where its worst stand-off sits: the balls around the point held worst are optimised
/// for themselves while all others stay; where that does not help, the ball its neighbours can do without most easily
/// is taken away from wherever it is, set down at the worst point, and both neighbourhoods are optimised. What lowers
/// the place's worst is kept, until it stays or the attempts are spent.
///
/// Never returns a worse set, nor one of more than `count` balls. An attempt costs about what optimising ten balls
/// does. Deterministic.
SphereSet relocate(const RelocationProblem& problem, SphereSet balls);

}  // namespace cairn::builder
