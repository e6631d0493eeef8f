// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "bound/cover_refutation.h"
#include "bound/search_watch.h"
#include "cairn/builder/bound.h"

namespace cairn::builder {

/// One stage of the search.
struct StepStage {
  std::vector<Vec3d> points;  ///< of the surface, see `spreadOverSurface`
  RefutationEffort effort;
  bool beginsLow = true;    ///< where a proof is found at once, not where the limit is likely
  int closeEnough = 1;      ///< steps that may lie between the proved one and an unproved one
  double from = 0, to = 1;  ///< how much of the whole work is done before and after the stage
};

/// Searches the largest error that can be proved too small for a number of spheres, with more points from stage to
/// stage. Errors tried are 2^(-step / 64) of the diagonal. What a stage proves stays proved, so the next one begins
/// above it.
class StepSearch {
 public:
  /// Keeps references.
  StepSearch(CoverRefuter& refuter, std::uint32_t spheres, double diagonal, SearchWatch& watch)
      : refuter_(refuter), spheres_(spheres), diagonal_(diagonal), watch_(watch) {}

  /// Ends when the stage's steps are close enough, or when it is told to stop.
  void run(const StepStage& stage);

  /// The best proof so far.
  ErrorBound best() const { return best_; }

 private:
  double errorAt(int step) const;
  bool prove(int step, const StepStage& stage);

  CoverRefuter& refuter_;
  std::uint32_t spheres_;
  double diagonal_;
  SearchWatch& watch_;
  int proved_ = -1;  ///< the smallest step that was; -1: none
  ErrorBound best_;
};

}  // namespace cairn::builder
