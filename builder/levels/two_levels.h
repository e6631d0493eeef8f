// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "levels/cover_level.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

struct TwoLevelProblem {
  const PointSet& points;  ///< on the whole surface, some tens for each ball of the lower level
  const PointSet& dense;   ///< many more: what the levels' limits hold for in the end
  const SignedDistance& solid;
  std::size_t branching = 8;
  std::uint64_t seed = 1;
  double negligible = 0;                 ///< stand-off not worth lowering, > 0
  bool deeper = false;                   ///< a third level follows: what it will need counts as well
  const KeepGoing* keepGoing = nullptr;  ///< see `LevelProblem`
};

/// Covers the surface with at most `branching` balls, and those with at most `branching` each, giving up a little of
/// the upper level's fit (`kAsGood`) for the lower level's: families are formed from a cover of the whole surface
/// by the lower level's balls alone, because the best upper level taken for itself leaves some families with far more
/// than their share of what is difficult. See docs/algorithms/adaptive.md. Deterministic, parallel inside.
std::vector<CoverLevel> coverTwoLevels(const TwoLevelProblem& problem);

/// The upper level alone.
CoverLevel coverOneLevel(const TwoLevelProblem& problem);

}  // namespace cairn::builder
