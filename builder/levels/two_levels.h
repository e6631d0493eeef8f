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
  const PointSet& dense;   ///< many more points: in the end the levels' limits hold for these
  const SignedDistance& solid;
  std::size_t branching = 8;
  std::uint64_t seed = 1;
  double negligible = 0;                 ///< stand-off not worth lowering, > 0
  bool deeper = false;                   ///< a third level follows, so its needs count as well
  const KeepGoing* keepGoing = nullptr;  ///< see `LevelProblem`
};

/// Covers the surface with at most `branching` balls, and each of these with at most `branching` balls. A little of the
/// upper level's fit (`kAsGood`) is given up for the lower level's. Families are formed from a cover of the whole
/// surface by the lower level's balls alone. The best upper level alone would leave some families with far more than
/// their share of difficult surface. See docs/algorithms/adaptive.md. Deterministic, parallel.
std::vector<CoverLevel> coverTwoLevels(const TwoLevelProblem& problem);

/// Covers the surface with the upper level alone.
CoverLevel coverOneLevel(const TwoLevelProblem& problem);

}  // namespace cairn::builder
