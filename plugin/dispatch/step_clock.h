// SPDX-License-Identifier: Zlib
#pragma once

#include <chrono>
#include <optional>

#include "cairn/bullet/step.h"
#include "cairn/core/budget.h"
#include "dispatch/overrun.h"
#include "dispatch/thread_cpu_clock.h"

namespace cairn::bullet {

/// When a step began, until when it may go on, and how long it took.
class StepClock {
 public:
  /// The step begins. Returns the budget to plan it with: earlier than its limit, by what steps ran over lately.
  StepBudget begin(StepBudget limit) {
    beganOnCpu_ = ThreadCpuClock::now();
    began_ = Budget::Clock::now();
    deadline_ = limit.microseconds;
    if (limit.microseconds) *limit.microseconds = overrun_.plannable(*limit.microseconds);
    planned_ = limit.microseconds;
    return limit;
  }
  /// Microseconds that the step may take, if there is a limit.
  std::optional<double> deadline() const { return deadline_; }
  /// The step ends. Returns the microseconds it took.
  double end() {
    const std::chrono::duration<double, std::micro> elapsed = Budget::Clock::now() - began_;
    if (planned_) overrun_.learn(elapsed.count(), *planned_);
    return elapsed.count();
  }
  /// Microseconds of its thread's processor time since it began.
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
