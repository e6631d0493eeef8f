// SPDX-License-Identifier: Zlib
#pragma once

#include <chrono>
#include <optional>

#include "cairn/bullet/step.h"
#include "cairn/core/budget.h"
#include "dispatch/overrun.h"
#include "platform/thread_cpu_clock.h"

namespace cairn::bullet {

/// The time of a step: its beginning, its deadline and its end.
class StepClock {
 public:
  /// Begins a step. Returns the budget to plan with: its deadline is earlier than the limit by recent overruns.
  StepBudget begin(StepBudget limit) {
    beganOnCpu_ = ThreadCpuClock::now();
    began_ = Budget::Clock::now();
    deadline_ = limit.microseconds;
    if (limit.microseconds) *limit.microseconds = overrun_.plannable(*limit.microseconds);
    planned_ = limit.microseconds;
    return limit;
  }
  /// Microseconds that the step may take, if it has a limit.
  std::optional<double> deadline() const { return deadline_; }
  /// Ends the step. Returns the microseconds it took.
  double end() {
    const std::chrono::duration<double, std::micro> elapsed = Budget::Clock::now() - began_;
    if (planned_) overrun_.learn(elapsed.count(), *planned_);
    return elapsed.count();
  }
  /// CPU time of the calling thread since the beginning, microseconds.
  double spentOnCpu() const {
    return std::chrono::duration<double, std::micro>(ThreadCpuClock::now() - beganOnCpu_).count();
  }

 private:
  Overrun overrun_;
  Budget::Clock::time_point began_;
  ThreadCpuClock::time_point beganOnCpu_;
  std::optional<double> deadline_, planned_;  // microseconds
};

}  // namespace cairn::bullet
