// SPDX-License-Identifier: Zlib
#pragma once

#include "dispatch/step_state.h"
#include "dispatch/step_tuning.h"

namespace cairn::bullet {

/// What becomes of the pairs of a step that are not brought up to date: they are held, and time and operations for that
/// are held back before.
class StepCarryOver {
 public:
  explicit StepCarryOver(StepState& step) : step_(step) {}

  /// Holds back what the plan's held pairs will take.
  void reserve();
  void withdraw();
  const CostModel& cost() const { return cost_; }
  void endStep();

  /// All that still wait, in the order of their names: callbacks may tell. But where time ran out the step before, what
  /// had to wait then comes first.
  void carryOverPairs();
  /// One, charged to this budget.
  PairReport carryOver(TreePair& pair, btManifoldResult& result, Budget& budget, bool isLate);

 private:
  bool isLargeShareOfStep(const Reservation& reserve) const;
  bool isTooLateFor(std::size_t pairs) const;
  void carryOverPair(std::size_t index, bool isLate);
  void prefetchAfter(std::size_t index, bool isLate) const;

  StepState& step_;
  Reservation reserved_;
  CostModel cost_{step_tuning::kCarryOverCost};      // of a pair that is held
  CostModel lateCost_{step_tuning::kCarryOverCost};  // of one that is when it is too late for that
  std::uint64_t firstLate_ = 0;  // the name of the first pair held in the last step for which it was too late
};

}  // namespace cairn::bullet
