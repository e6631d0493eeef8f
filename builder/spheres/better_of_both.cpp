// SPDX-License-Identifier: GPL-3.0-or-later
#include "better_of_both.h"

#include <utility>

#include "cover/optimise.h"
#include "spheres/expand.h"
#include "spheres/merge.h"

namespace cairn::builder {

SphereSet expandFor(Optimiser optimiser, const CoverProblem& problem, const Candidates& candidates) {
  return expand(problem, candidates.all, ExpandRank::maxElim,
                optimiser == Optimiser::cairn ? ExpandLimits{} : kNoExpandLimits);
}

SphereSet betterOfBoth(Optimiser optimiser, const CoverProblem& problem, const Candidates& candidates) {
  SphereSet expanded = expandFor(optimiser, problem, candidates), merged = merge(problem, candidates.covering);
  if (optimiser == Optimiser::cairn) {
    expanded = optimise(problem, std::move(expanded));
    merged = optimise(problem, std::move(merged));
  }
  return coverStandOff(problem.points, merged) < coverStandOff(problem.points, expanded) ? merged : expanded;
}

}  // namespace cairn::builder
