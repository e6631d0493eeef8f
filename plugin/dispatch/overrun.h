// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>

namespace cairn::bullet {

/// How much longer than planned steps take. What is done for a pair is not stopped half-way, and a machine that is
/// shared is slower at times than it was a moment ago: what steps took too long, those after them are planned to end
/// earlier, less so with every step that ends as planned. Microseconds.
class Overrun {
 public:
  /// The time to plan with where a step may take `allowed`: three quarters of it at least, so that one long disturbance
  /// does not stop all work. What was learnt of steps that might take more than twice as long, or less than half, is
  /// forgotten.
  double plannable(double allowed) {
    if (allowed > kAlike * allowed_ || kAlike * allowed < allowed_) expected_ = 0;
    allowed_ = allowed;
    return allowed - std::min(expected_, kMaxShare * allowed);
  }
  /// A step that was planned to take `planned`, as `plannable` said last, took `taken`.
  void learn(double taken, double planned) {
    expected_ = std::min(std::max(taken - planned, kKept * expected_), kMaxShare * allowed_);
  }

 private:
  static constexpr double kMaxShare = 0.25, kKept = 0.95, kAlike = 2;
  double expected_ = 0;
  double allowed_ = 0;
};

}  // namespace cairn::bullet
