// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>

namespace cairn::bullet {

/// Learns by how much steps exceed their plan. Work on a pair is not stopped half-way, and a shared machine may slow
/// down suddenly. After an overrun the next steps are planned to end earlier; the correction fades with every step that
/// ends as planned. Microseconds.
class Overrun {
 public:
  /// The time to plan with in a step that may take `allowed`. It is at least three quarters of `allowed`, so that one
  /// long disturbance does not stop all work. Overruns of steps with less than half or more than twice the time are
  /// forgotten.
  double plannable(double allowed) {
    if (allowed > kAlike * allowed_ || kAlike * allowed < allowed_) expected_ = 0;
    allowed_ = allowed;
    return allowed - std::min(expected_, kMaxShare * allowed);
  }
  /// A step took `taken`; it was planned to take `planned`, the last result of `plannable`.
  void learn(double taken, double planned) {
    expected_ = std::min(std::max(taken - planned, kKept * expected_), kMaxShare * allowed_);
  }

 private:
  static constexpr double kMaxShare = 0.25, kKept = 0.95, kAlike = 2;
  double expected_ = 0;
  double allowed_ = 0;
};

}  // namespace cairn::bullet
