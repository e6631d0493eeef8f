// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/figures/bare_deadline.h"

#include <atomic>
#include <chrono>
#include <utility>
#include <vector>

#include "scenes/figures/cpu_clock.h"

namespace cairn::scenes {
namespace {

// About a microsecond of work that the compiler cannot remove.
void passTime() {
  constexpr int kRounds = 3000;
  std::atomic<int> passed = 0;
  for (int round = 0; round < kRounds; ++round) passed.store(round, std::memory_order_relaxed);
}

}  // namespace

Quantiles bareDeadline(double microseconds, std::uint32_t times) {
  using Clock = std::chrono::steady_clock;
  const std::chrono::duration<double, std::micro> allowed(microseconds);
  std::vector<double> taken;
  for (std::uint32_t i = 0; i < times; ++i) {
    const double start = threadCpuMicroseconds();
    const auto began = Clock::now();
    while (Clock::now() - began < allowed) passTime();
    taken.push_back(threadCpuMicroseconds() - start);
  }
  return quantilesOf(std::move(taken));
}

}  // namespace cairn::scenes
