// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>

namespace cairn {

/// Narrow-phase operations of Eq. 2.1 of Bradshaw's thesis, with the constants of its section 7.2.
inline constexpr std::uint32_t kSphereUpdateCost = 2;
inline constexpr std::uint32_t kOverlapTestCost = 1;

/// Work that has to be done once refinement has stopped, whatever is left then: contacts to be made of what was found.
struct Reservation {
  std::uint64_t operations = 0;
  double nanoseconds = 0;  ///< expected
};

/// How much work may still be done: operations (reproducible), time (not), or whichever ends first.
///
/// Work is charged *before* it is done and only if it fits, so an operation budget is never exceeded. Time is looked at
/// every `kClockInterval` operations; it can be exceeded by that much work and what is charged at once: eight steps of
/// a traversal of two trees, 80 operations.
class Budget {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::uint32_t kClockInterval = 256;
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  static Budget unlimited() { return Budget(kUnlimited, Clock::time_point::max()); }
  static Budget operations(std::uint64_t count) { return Budget(count, Clock::time_point::max()); }
  /// Runs from now. Precondition: `microseconds >= 0`.
  static Budget time(double microseconds) { return both(kUnlimited, microseconds); }
  static Budget both(std::uint64_t operations, double microseconds);

  /// Takes `cost` operations if they fit and the time is not up; otherwise takes nothing. `charge(0)` asks about time
  /// alone.
  bool charge(std::uint32_t cost) {
    if (cost > remaining() || timeIsUp()) return false;
    forceCharge(cost);
    return true;
  }

  /// Books work that is done whatever is left (re-testing known contacts): what is left shrinks, down to nothing.
  void forceCharge(std::uint64_t cost) {
    remaining_ -= cost < remaining_ ? cost : remaining_;
    used_ += cost;
    sinceClock_ += cost;
  }

  /// Holds back what promised work will take, until `release` gives it free for the work itself. Promises may exceed
  /// what is left; then nothing more is charged.
  void reserve(const Reservation& work) {
    reservedOperations_ += work.operations;
    reservedNanoseconds_ += work.nanoseconds;
  }
  /// What was promised before; never more than all promises come to.
  void release(const Reservation& work) {
    reservedOperations_ -= std::min(reservedOperations_, work.operations);
    reservedNanoseconds_ = std::max(reservedNanoseconds_ - work.nanoseconds, 0.0);
  }

  /// Lets the next `operations`, if there are as many, through whatever the clock says: what is given no time at all
  /// would never end.
  void guarantee(std::uint64_t operations) { guaranteedUntil_ = used_ + operations; }

  std::uint64_t used() const { return used_; }
  /// What may still be charged: promised work is held back.
  std::uint64_t remaining() const { return remaining_ - std::min(remaining_, reservedOperations_); }
  /// Until the deadline, promised work not held back; infinite without one, negative after it.
  double nanosecondsLeft() const;
  /// The same, with what is promised held back: may be negative.
  double nanosecondsFree() const { return nanosecondsLeft() - reservedNanoseconds_; }
  /// Whether work that was charged as a whole should stop: a look at the clock, where there is a deadline.
  bool isLate() { return hasDeadline() && lookAtClock(); }
  bool hasDeadline() const { return deadline_ != Clock::time_point::max(); }

 private:
  Budget(std::uint64_t operations, Clock::time_point deadline) : remaining_(operations), deadline_(deadline) {}
  bool timeIsUp() { return hasDeadline() && sinceClock_ >= kClockInterval && lookAtClock(); }
  bool lookAtClock();

  std::uint64_t remaining_;
  std::uint64_t reservedOperations_ = 0;
  double reservedNanoseconds_ = 0;
  std::uint64_t used_ = 0;
  std::uint64_t guaranteedUntil_ = 0;
  std::uint64_t sinceClock_ = kClockInterval;  // look at once: a budget of zero microseconds does nothing
  Clock::time_point deadline_;
};

}  // namespace cairn
