// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "spheres/level_cover.h"

namespace cairn::builder {

/// Second chances for a level where its maximum sits: the families that may hold the point held worst, and those that
/// share most surface with them, are optimised for themselves while all others stay; where that does not help, a ball
/// of theirs is taken away and set down again where the cover is worst, the most dispensable first. What lowers their
/// worst is kept, until the level's worst stays or `attempts` such optimisations are spent.
///
/// Returns a level at least as good as `level`, ordered by parent. An attempt costs about what optimising three
/// families does; the points that families outside hold within what is asked for do not count. Deterministic.
std::vector<ChildBall> relieveLevel(const LevelProblem& problem, const std::vector<ChildBall>& level,
                                    std::size_t attempts);

}  // namespace cairn::builder
