// SPDX-License-Identifier: Zlib
#pragma once

#include <ctime>

namespace cairn::bench {

/// CPU time this thread has used: not disturbed by what else the machine does. POSIX.
inline double cpuSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace cairn::bench
