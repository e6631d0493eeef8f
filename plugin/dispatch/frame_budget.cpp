// SPDX-License-Identifier: Zlib
#include "cairn/bullet/frame_budget.h"

#include <algorithm>
#include <utility>

namespace cairn::bullet {

void FrameBudget::begin(int steps) {
  left_ = perFrame_;
  stepsLeft_ = std::max(steps, 0);
}

StepBudget FrameBudget::share() const {
  if (stepsLeft_ == 0) return perFrame_;
  StepBudget share = left_;
  if (share.operations) *share.operations /= stepsLeft_;
  if (share.microseconds) *share.microseconds /= stepsLeft_;
  return share;
}

void FrameBudget::spend(std::uint64_t operations, double microseconds) {
  if (stepsLeft_ == 0) return;
  --stepsLeft_;
  if (left_.operations) {
    const bool isAll = std::cmp_greater_equal(operations, *left_.operations);
    *left_.operations = isAll ? 0 : *left_.operations - static_cast<std::int64_t>(operations);
  }
  if (left_.microseconds) *left_.microseconds = std::max(*left_.microseconds - microseconds, 0.0);
}

StepBudget tighter(const StepBudget& x, const StepBudget& y) {
  const auto smaller = [](const auto& a, const auto& b) { return a && b ? std::min(a, b) : a ? a : b; };
  return {smaller(x.operations, y.operations), smaller(x.microseconds, y.microseconds)};
}

}  // namespace cairn::bullet
