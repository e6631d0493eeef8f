// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace cairn::tool {

/// Wall and CPU time (all threads) since its construction.
class Stopwatch {
 public:
  Stopwatch();
  double wallSeconds() const;
  double cpuSeconds() const;

 private:
  std::chrono::steady_clock::time_point start_;
  double startCpu_;
};

/// Peak memory of the program so far, in mebibytes.
double peakMemoryMb();

}  // namespace cairn::tool
