// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "levels/cover_level.h"

namespace cairn::builder {

struct FamilySettings {
  std::size_t branching = 8;             ///< largest number of balls in a family
  std::size_t points = 400;              ///< largest number of points that a family is fitted to
  int swapRounds = 1;                    ///< rounds of `optimiseBySwaps`
  std::uint64_t seed = 1;                ///< for the choice of points
  double negligible = 0;                 ///< stand-off not worth lowering, > 0
  const KeepGoing* keepGoing = nullptr;  ///< see `LevelProblem`
};

/// Covers each family's own points alone, as if it had no neighbours. `owned` lists the points by family. The balls'
/// stand-offs are those needed by the chosen points. Deterministic, parallel.
std::vector<ChildBall> fitFamilies(const Reach& owned, const PointSet& points, const DepthField& field,
                                   const FamilySettings& settings);

}  // namespace cairn::builder
