// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "levels/cover_level.h"
#include "levels/relieve_level.h"

namespace cairn::builder {

/// The input of `completeLevel`.
struct LevelSurface {
  PointSet& points;                   ///< the points that the level was fitted to; the costliest of `dense` join them
  const PointSet& dense;              ///< the points for which the level's limit must hold
  std::span<const CoverLevel> above;  ///< its ancestors, top level first
  const DepthField& field;            ///< source of the depths of the level's balls
  std::size_t branching = 8;
  double negligible = 0;                 ///< stand-off not worth lowering, > 0
  const KeepGoing* keepGoing = nullptr;  ///< see `LevelProblem`
};

/// Lowers the level's worst stand-off (`relieveLevel`), then that of the surface between its points. The costliest
/// dense points join the level's points, and the families there are relieved again, a few times. Returns the level with
/// the lowest limit seen; limits hold for the dense points. `effort` is that of the first relief; later reliefs spend
/// less. Deterministic.
CoverLevel completeLevel(const LevelSurface& surface, CoverLevel level, const ReliefEffort& effort);

}  // namespace cairn::builder
