// SPDX-License-Identifier: Zlib
#pragma once

#include "dispatch/step_state.h"
#include "dispatch/step_tuning.h"

namespace cairn::bullet {

/// Carries over the pairs that a step does not update. Time and operations for it are reserved before.
class StepCarryOver {
 public:
  explicit StepCarryOver(StepState& step) : step_(step) {}

  /// Reserves the cost of the pairs that the plan carries over.
  void reserve();
  void withdraw();
  const CostModel& cost() const { return cost_; }
  void endStep();

  /// Carries over all pairs that still wait, in the order of their names, because callbacks may observe it. After a
  /// step that ran out of time, the pairs that waited longest come first.
  void carryOverPairs();
  /// Carries one pair over, charged to this budget.
  void carryOver(TreePair& pair, btManifoldResult& result, Budget& budget, bool isLate);

 private:
  bool isLargeShareOfStep(const Reservation& reserve) const;
  bool isTooLateFor(std::size_t pairs) const;
  void carryOverPair(std::size_t index, bool isLate);
  void prefetchAfter(std::size_t index, bool isLate) const;

  StepState& step_;
  Reservation reserved_;
  CostModel cost_{step_tuning::kCarryOverCost};      // of a pair carried over in time
  CostModel lateCost_{step_tuning::kCarryOverCost};  // of a pair carried over after the deadline
  std::uint64_t firstLate_ = 0;                      // name of the first pair that was too late in the last step
};

}  // namespace cairn::bullet
