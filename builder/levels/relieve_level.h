// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "cover/level_cover.h"

namespace cairn::builder {

/// What a relief may spend.
struct ReliefEffort {
  std::size_t attempts = 0;  ///< optimisations of a few families, in all
  /// Times the family that pays most is begun anew, before a point is given up. Worth it where a family has surface no
  /// other may hold; it costs several times what moving its balls does.
  std::size_t redraws = 0;
};

/// Second chances for a level where its maximum sits: the families that may hold the point held worst, and those that
/// share most surface with them, are optimised for themselves while all others stay; where that does not help, a ball
/// of theirs is taken away and set down again where the cover is worst, the most dispensable first; at last the family
/// itself is drawn anew, from first balls spread over what it may hold. What lowers their worst is kept, until the
/// level's worst stays or the attempts are spent.
///
/// Returns a level at least as good as `level`, ordered by parent. An attempt costs about what optimising three
/// families does; the points that families outside hold within what is asked for do not count. Deterministic.
std::vector<ChildBall> relieveLevel(const LevelProblem& problem, const std::vector<ChildBall>& level,
                                    const ReliefEffort& effort);

}  // namespace cairn::builder
