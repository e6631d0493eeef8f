// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "cover/level_cover.h"

namespace cairn::builder {

/// The effort that a relief may spend.
struct ReliefEffort {
  std::size_t attempts = 0;  ///< total number of optimisations of a few families
  /// Number of times the family with the most to gain is started anew before a point is given up. This helps where a
  /// family has surface that no other may hold. It costs several times as much as moving the family's balls.
  std::size_t redraws = 0;
};

/// Lowers the maximum of a level where it occurs, in three steps. First the families that may hold the worst point, and
/// those that share most surface with them, are optimised alone. If this fails, one of their balls is removed and
/// placed where the cover is worst, the most dispensable ball first. At last the family itself is started anew, from
/// first balls spread over its reach. A change is kept if it lowers the worst stand-off of these families. The search
/// ends when the level's worst stays or the attempts are spent.
///
/// Returns a level at least as good as `level`, ordered by parent. An attempt costs about as much as optimising three
/// families. Points that other families hold within the requested stand-off do not count. Deterministic.
std::vector<ChildBall> relieveLevel(const LevelProblem& problem, const std::vector<ChildBall>& level,
                                    const ReliefEffort& effort);

}  // namespace cairn::builder
