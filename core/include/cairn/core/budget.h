// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>

#include "cairn/core/export.h"

namespace cairn {

/// Operations of moving one sphere into another frame. These costs are those of Eq. 2.1 of Bradshaw's thesis, with the
/// constants of its section 7.2.
inline constexpr std::uint32_t kSphereUpdateCost = 2;
/// Operations of one overlap test of two spheres.
inline constexpr std::uint32_t kOverlapTestCost = 1;

/// Part of a budget that is reserved for work after refinement, such as making contacts.
struct Reservation {
  std::uint64_t operations = 0;  ///< the reserved number of operations
  double nanoseconds = 0;        ///< expected time of that work
};

/// How much work may still be done: a number of operations (reproducible), a time (not reproducible), or whichever ends
/// first.
///
/// Work is charged *before* it is done and only if it fits, so an operation budget is never exceeded. The clock is read
/// every `kClockInterval` operations. A deadline can be exceeded by that much work and by one charge: eight steps of a
/// traversal of two trees, 80 operations.
class CAIRN_CORE_EXPORT Budget {
 public:
  /// The clock of deadlines: it never goes back.
  using Clock = std::chrono::steady_clock;
  /// Operations between two looks at the clock.
  static constexpr std::uint32_t kClockInterval = 256;
  /// The number of operations that means no limit.
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  /// A budget without a limit.
  static Budget unlimited() { return Budget(kUnlimited, Clock::time_point::max()); }
  /// A budget of `count` operations, without a deadline.
  static Budget operations(std::uint64_t count) { return Budget(count, Clock::time_point::max()); }
  /// A deadline this many microseconds from now. Precondition: `microseconds >= 0`.
  static Budget time(double microseconds) { return both(kUnlimited, microseconds); }
  /// A budget of operations with a deadline this many microseconds from now. Precondition: `microseconds >= 0`.
  static Budget both(std::uint64_t operations, double microseconds);

  /// Charges `cost` operations if they fit and the deadline has not passed; charges nothing otherwise. `charge(0)` asks
  /// about the deadline alone.
  bool charge(std::uint32_t cost) {
    if (cost > remaining() || timeIsUp()) return false;
    forceCharge(cost);
    return true;
  }

  /// Charges work that is done in any case, such as measuring known contacts again. The rest falls to zero at least.
  void forceCharge(std::uint64_t cost) {
    remaining_ -= cost < remaining_ ? cost : remaining_;
    used_ += cost;
    sinceClock_ += cost;
  }

  /// Reserves for later work, until `release`. Reservations may exceed the rest; then nothing more can be charged.
  void reserve(const Reservation& work) {
    reservedOperations_ += work.operations;
    reservedNanoseconds_ += work.nanoseconds;
  }
  /// Releases a reservation; never more than all reservations together.
  void release(const Reservation& work) {
    reservedOperations_ -= std::min(reservedOperations_, work.operations);
    reservedNanoseconds_ = std::max(reservedNanoseconds_ - work.nanoseconds, 0.0);
  }

  /// Lets the next `operations` through whatever the clock says, if there are as many. Without this a budget of no time
  /// would never end.
  void guarantee(std::uint64_t operations) { guaranteedUntil_ = used_ + operations; }

  /// Operations charged so far.
  std::uint64_t used() const { return used_; }
  /// Operations that may still be charged, reservations excluded.
  std::uint64_t remaining() const { return remaining_ - std::min(remaining_, reservedOperations_); }
  /// Nanoseconds until the deadline, reservations included. Infinite without a deadline, negative after it.
  double nanosecondsLeft() const;
  /// Nanoseconds until the deadline, reservations excluded; may be negative.
  double nanosecondsFree() const { return nanosecondsLeft() - reservedNanoseconds_; }
  /// Whether work that was charged as a whole should stop: reads the clock, if there is a deadline.
  bool isLate() { return hasDeadline() && lookAtClock(); }
  /// Whether the budget has a deadline.
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
  std::uint64_t sinceClock_ = kClockInterval;  // read the clock at once: a budget of zero microseconds does nothing
  Clock::time_point deadline_;
};

}  // namespace cairn
