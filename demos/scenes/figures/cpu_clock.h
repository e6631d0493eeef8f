// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>

namespace cairn::scenes {

/// CPU time this thread has used: unlike the wall clock, not disturbed by what else the machine does. POSIX. About 0.2
/// us.
inline double threadCpuMicroseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

}  // namespace cairn::scenes
