// SPDX-License-Identifier: Zlib
#include "cairn/core/budget.h"

#include <cassert>

namespace cairn {

namespace {
// About eleven days: longer budgets than this would overflow the clock's arithmetic and mean "unlimited" anyway.
constexpr double kLongestMicroseconds = 1e12;
}  // namespace

Budget Budget::both(std::uint64_t operations, double microseconds) {
  assert(microseconds >= 0);
  if (!(microseconds < kLongestMicroseconds)) return Budget(operations, Clock::time_point::max());
  const auto duration = std::chrono::duration<double, std::micro>(microseconds);
  return Budget(operations, Clock::now() + std::chrono::duration_cast<Clock::duration>(duration));
}

double Budget::nanosecondsLeft() const {
  if (!hasDeadline()) return std::numeric_limits<double>::infinity();
  return std::chrono::duration<double, std::nano>(deadline_ - Clock::now()).count();
}

bool Budget::lookAtClock() {
  if (used_ < guaranteedUntil_) return false;
  const auto reserved = std::chrono::duration<double, std::nano>(reservedNanoseconds_);
  if (Clock::now() + std::chrono::duration_cast<Clock::duration>(reserved) >= deadline_)
    return true;  // sinceClock_ stays high: once the time is up, every look says so
  sinceClock_ = 0;
  return false;
}

}  // namespace cairn
