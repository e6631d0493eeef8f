// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "levels/cover_level.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

struct TwoLevelProblem;

/// Covers of the whole surface by at most `branching` balls, each as tight as a search from a start of its own finds:
/// local optima of the same problem, among which the level below can choose.
struct UpperCovers {
  std::vector<CoverLevel> covers;     ///< at least one, the tightest first; limits hold for the dense points
  std::unique_ptr<DepthField> field;  ///< in which they were fitted
  PointSet points;                    ///< the problem's, and those of the dense ones that cost most
};

/// Deterministic, parallel inside.
UpperCovers upperCovers(const TwoLevelProblem& problem);

}  // namespace cairn::builder
