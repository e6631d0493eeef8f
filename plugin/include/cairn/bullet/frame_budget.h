// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/bullet/step.h"
#include "cairn/core/export.h"

namespace cairn::bullet {

/// A budget for a whole frame, shared by the simulation steps in it. Each step may use an equal part of the rest. So
/// later steps gain what an earlier step leaves, and pay for what it overspends.
///
///     FrameBudget frame({.operations = 50000});
///     frame.begin(steps);
///     for (int i = 0; i < steps; ++i) { budgetOfStep = frame.share(); ...; frame.spend(operations, microseconds); }
///
/// The front ends hold one (`setFrameBudget`, `beginFrame`), and `stepFrame` in step_frame.h counts the steps for them.
/// Use the class directly only where you drive steps yourself.
class CAIRN_BULLET_EXPORT FrameBudget {
 public:
  FrameBudget() = default;
  /// The budget of every frame from now on; an unset field is no limit. The current frame starts anew.
  explicit FrameBudget(const StepBudget& perFrame) : perFrame_(perFrame), left_(perFrame) {}

  /// Begins a frame of `steps` steps; the rest of the last frame's budget lapses. A value of 0 or less announces no
  /// step. Each step beyond those announced gets the whole budget.
  void begin(int steps);

  /// The budget of the next step: the rest, divided by the number of steps left. Operations are rounded down.
  StepBudget share() const;
  /// Subtracts the whole cost of a step from the rest, which never falls below 0.
  void spend(std::uint64_t operations, double microseconds);

 private:
  StepBudget perFrame_, left_;
  int stepsLeft_ = 0;
};

/// The smaller value of each limit; an unset field is no limit.
StepBudget tighter(const StepBudget& x, const StepBudget& y);

}  // namespace cairn::bullet
