// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/stopwatch.h"

#include <sys/resource.h>

namespace cairn::tool {
namespace {

rusage usage() {
  rusage r{};
  getrusage(RUSAGE_SELF, &r);
  return r;
}

double processCpuSeconds() {
  const rusage r = usage();
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(r.ru_utime) + seconds(r.ru_stime);
}

}  // namespace

Stopwatch::Stopwatch() : start_(std::chrono::steady_clock::now()), startCpu_(processCpuSeconds()) {}

double Stopwatch::wallSeconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double Stopwatch::cpuSeconds() const {
  return processCpuSeconds() - startCpu_;
}

double peakMemoryMb() {
  return static_cast<double>(usage().ru_maxrss) / 1024;
}

}  // namespace cairn::tool
