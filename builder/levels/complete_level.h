// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "levels/cover_level.h"
#include "levels/relieve_level.h"

namespace cairn::builder {

/// What a level is completed on.
struct LevelSurface {
  PointSet& points;                   ///< the level was fitted to; those of `dense` that cost most join them
  const PointSet& dense;              ///< what the level's limit is to hold for
  std::span<const CoverLevel> above;  ///< its ancestors, top level first
  const DepthField& field;            ///< the level's balls have their depths of
  std::size_t branching = 8;
  double negligible = 0;                 ///< stand-off not worth lowering, > 0
  const KeepGoing* keepGoing = nullptr;  ///< see `LevelProblem`
};

/// Lowers the level's worst (`relieveLevel`), then what lies between its points: those of the dense points that cost
/// most join them and the families there are relieved again, a few times. Returns the level with the lowest limit seen;
/// limits hold for the dense points. `effort`: of the first relief; the others spend less. Deterministic.
CoverLevel completeLevel(const LevelSurface& surface, CoverLevel level, const ReliefEffort& effort);

}  // namespace cairn::builder
