// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>

namespace cairn::bullet {

/// How much longer than they may steps take. What is done for a pair is not stopped half-way, and a machine that is
/// shared is slower at times than it was a moment ago: what steps took too long, those after them are planned to end
/// earlier, less so with every step that is in time. Microseconds.
class Overrun {
 public:
  /// The time to plan with where a step may take `allowed`: three quarters of it at least, so that one long disturbance
  /// does not stop all work.
  double plannable(double allowed) const { return std::max(allowed - expected_, kLeastShare * allowed); }
  /// A step that was planned to take `planned` took `taken`.
  void learn(double taken, double planned) { expected_ = std::max(taken - planned, kKept * expected_); }

 private:
  static constexpr double kLeastShare = 0.75, kKept = 0.95;
  double expected_ = 0;
};

}  // namespace cairn::bullet
