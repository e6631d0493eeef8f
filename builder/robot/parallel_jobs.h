// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// The part of the whole work that some jobs are.
struct WorkShare {
  std::string_view stage;
  double begin = 0, end = 1;  ///< fractions of the whole
};

/// Runs `job(i, progress)` for i = 0..count-1 in parallel and returns the first failure by index, so that messages do
/// not depend on the order of the work. The progress a job gets only asks whether to go on. A job that other jobs wait
/// for never starts inside another: each is isolated.
inline Status runJobs(std::size_t count, const WorkShare& share, const ProgressCallback& progress,
                      const std::function<Status(std::size_t, const ProgressCallback&)>& job) {
  std::mutex mutex;
  std::size_t done = 0;
  bool goesOn = true;
  const auto told = [&](bool another) {
    const std::lock_guard lock(mutex);
    if (another) ++done;
    const double part = count == 0 ? 1 : static_cast<double>(done) / static_cast<double>(count);
    if (goesOn && progress && !progress(share.stage, share.begin + (share.end - share.begin) * part)) goesOn = false;
    return goesOn;
  };
  const ProgressCallback asks = [&](std::string_view, double) { return told(false); };
  std::vector<std::optional<Error>> failures(count);
  tbb::parallel_for(
      std::size_t{0}, count,
      [&](std::size_t i) {
        if (!told(false)) return;
        tbb::this_task_arena::isolate([&] {
          if (Status s = job(i, asks); !s) failures[i] = s.error();
        });
        told(true);
      },
      tbb::simple_partitioner());
  if (!goesOn) return Error{std::string(kCancelled)};
  const auto failed = std::find_if(failures.begin(), failures.end(), [](const auto& f) { return f.has_value(); });
  return failed == failures.end() ? Status() : Status(**failed);
}

}  // namespace cairn::builder
