// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <string_view>

#include "cairn/builder/progress.h"

namespace cairn::builder {

/// Passes progress on from one thread at a time, never falling, and remembers that it was told to stop.
class ProgressWatch {
 public:
  explicit ProgressWatch(const ProgressCallback& callback) : callback_(callback) {}

  /// Tells how far the work is; false once it is to stop.
  bool report(std::string_view stage, double fraction) {
    if (!callback_ || stopped_) return !stopped_;
    const std::lock_guard lock(mutex_);
    fraction_ = std::max(fraction_, fraction);
    if (!callback_(stage, fraction_)) stopped_ = true;
    return !stopped_;
  }
  /// Asks whether to go on, without progress to tell.
  bool goesOn(std::string_view stage) { return report(stage, 0); }

 private:
  const ProgressCallback& callback_;
  std::mutex mutex_;
  double fraction_ = 0;
  std::atomic<bool> stopped_ = false;
};

}  // namespace cairn::builder
