// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/bullet/step.h"

namespace cairn::bullet {

/// A budget for a whole frame, shared by the simulation steps in it: each may use an equal part of what is left, so
/// what a quiet step leaves, and what a step spends beyond its part, is the business of those after it.
///
/// The front ends hold one (`setFrameBudget`, `beginFrame`; `stepFrame` in `step_frame.h` does the counting); it stands
/// alone for whoever drives steps otherwise.
class FrameBudget {
 public:
  FrameBudget() = default;
  /// Of every frame from now on; unset fields are no limit. The frame at hand starts anew.
  explicit FrameBudget(const StepBudget& perFrame) : perFrame_(perFrame), left_(perFrame) {}

  /// A new frame of `steps` steps; what is left of the last one lapses. 0 or less: a frame of no steps. Steps beyond
  /// those announced are frames of their own, each with the whole budget.
  void begin(int steps);

  /// What the next step may use: what is left, divided by the steps left (operations are rounded down).
  StepBudget share() const;
  /// What a step has used, refinement and all: it is taken from what is left, which does not go below nothing.
  void spend(std::uint64_t operations, double microseconds);

 private:
  StepBudget perFrame_, left_;
  int stepsLeft_ = 0;
};

/// The smaller of each limit.
StepBudget tighter(const StepBudget& x, const StepBudget& y);

}  // namespace cairn::bullet
