// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "levels/cover_level.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

struct TwoLevelProblem;

/// Covers of the whole surface by at most `branching` balls, each as tight as a search from its own start finds. They
/// are local optima of one problem; the level below can choose among them.
struct UpperCovers {
  std::vector<CoverLevel> covers;     ///< at least one, the tightest first; limits hold for the dense points
  std::unique_ptr<DepthField> field;  ///< the field in which they were fitted
  PointSet points;                    ///< the problem's points and the costliest dense ones
};

/// Computes the covers. Deterministic, parallel.
UpperCovers upperCovers(const TwoLevelProblem& problem);

}  // namespace cairn::builder
