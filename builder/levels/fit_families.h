// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "levels/cover_level.h"

namespace cairn::builder {

struct FamilySettings {
  std::size_t branching = 8;             ///< most balls of a family
  std::size_t points = 400;              ///< most points of a family it is fitted to
  int swapRounds = 1;                    ///< of `optimiseBySwaps`
  std::uint64_t seed = 1;                ///< of the choice of points
  double negligible = 0;                 ///< stand-off not worth lowering, > 0
  const KeepGoing* keepGoing = nullptr;  ///< see `LevelProblem`
};

/// Covers each family's own points for itself, as if it had no neighbours. By family: `owned`. The balls' stand-offs
/// are what the chosen points need. Deterministic, parallel.
std::vector<ChildBall> fitFamilies(const Reach& owned, const PointSet& points, const DepthField& field,
                                   const FamilySettings& settings);

}  // namespace cairn::builder
