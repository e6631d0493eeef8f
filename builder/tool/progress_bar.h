// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

#include "cairn/builder/progress.h"

namespace cairn::tool {

/// A line on standard error that follows a piece of work where that is a terminal, and else a new line every five
/// seconds after the first two, for logs; and the way Ctrl-C reaches the work: the callback asks to cancel once an
/// interrupt has arrived.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();  ///< wipes the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Valid while the bar lives.
  builder::ProgressCallback callback();

 private:
  bool visible_;
  std::chrono::steady_clock::time_point nextLine_;
  int shownPercent_ = -1;
};

}  // namespace cairn::tool
