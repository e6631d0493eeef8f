// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "tool/interrupt.h"

namespace cairn::tool {

ProgressBar::ProgressBar() : visible_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (shownPercent_ >= 0) fmt::print(stderr, "\r\033[K");
}

builder::ProgressCallback ProgressBar::callback() {
  return [this](std::string_view stage, double fraction) {
    const int percent = static_cast<int>(100 * fraction);
    if (visible_ && percent != shownPercent_) {
      constexpr int kWidth = 40;
      const int filled = percent * kWidth / 100;
      fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {:3} % {}", "", filled, "", kWidth - filled, percent, stage);
      std::fflush(stderr);
      shownPercent_ = percent;
    }
    return !interrupted();
  };
}

}  // namespace cairn::tool
