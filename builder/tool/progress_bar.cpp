// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "tool/interrupt.h"

namespace cairn::tool {

namespace {

// A log is not to be filled, and short work is not to speak at all.
constexpr std::chrono::seconds kBeforeFirstLine(2), kBetweenLines(5);

}  // namespace

ProgressBar::ProgressBar()
    : visible_(isatty(STDERR_FILENO) != 0), nextLine_(std::chrono::steady_clock::now() + kBeforeFirstLine) {}

ProgressBar::~ProgressBar() {
  if (shownPercent_ >= 0) fmt::print(stderr, "\r\033[K");
}

builder::ProgressCallback ProgressBar::callback() {
  return [this](std::string_view stage, double fraction) {
    const int percent = static_cast<int>(100 * fraction);
    if (!visible_ && std::chrono::steady_clock::now() >= nextLine_) {
      nextLine_ = std::chrono::steady_clock::now() + kBetweenLines;
      fmt::print(stderr, "cairn: {:3} % {}\n", percent, stage);
    }
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
