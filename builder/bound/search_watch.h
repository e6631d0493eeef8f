// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "cairn/builder/progress.h"
#include "certify/progress_watch.h"

namespace cairn::builder {

/// Ends a search when its user cancels it or its time is up, and passes its progress on. Both ends are final.
class SearchWatch {
 public:
  /// Keeps a reference to `progress`. `seconds`: wall time from now; nothing: no limit.
  SearchWatch(const ProgressCallback& progress, std::optional<double> seconds) : watch_(progress), seconds_(seconds) {}

  /// False once the search is to end. From any thread, as often as liked: the user is asked every few milliseconds.
  bool goesOn() {
    const double now = elapsed();
    if (seconds_ && now >= *seconds_) timeIsUp_ = true;
    if (timeIsUp_ || cancelled_) return false;
    if (now < next_) return true;
    next_ = now + kSecondsBetweenReports;
    if (!watch_.report(stage_, seconds_ ? now / *seconds_ : share_)) cancelled_ = true;
    return !cancelled_;
  }

  /// Says what the search is at, and how much of it is done; no other thread may be in `goesOn`.
  void enter(std::string stage, double share) {
    stage_ = std::move(stage);
    share_ = share;
    next_ = 0;
  }

  bool cancelled() const { return cancelled_; }
  bool timeIsUp() const { return timeIsUp_; }

 private:
  static constexpr double kSecondsBetweenReports = 0.01;

  double elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  ProgressWatch watch_;
  std::optional<double> seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::string stage_;
  double share_ = 0;
  std::atomic<double> next_ = 0;  // seconds from the start
  std::atomic<bool> cancelled_ = false, timeIsUp_ = false;
};

}  // namespace cairn::builder
