// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/world/task_scheduler.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>

namespace cairn::scenes {

namespace tbb = oneapi::tbb;
using Range = tbb::blocked_range<int>;

TbbScheduler::TbbScheduler(int threads) : btITaskScheduler("oneTBB") {
  setNumThreads(threads);
}
TbbScheduler::~TbbScheduler() = default;

int TbbScheduler::getMaxNumThreads() const {
  return tbb::info::default_concurrency();
}

void TbbScheduler::setNumThreads(int threads) {
  arena_.terminate();
  most_ = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                static_cast<std::size_t>(std::max(threads, getMaxNumThreads())));
  arena_.initialize(threads);
}

void TbbScheduler::parallelFor(int begin, int end, int grain, const btIParallelForBody& body) {
  arena_.execute([&] {
    tbb::parallel_for(
        Range(begin, end, static_cast<std::size_t>(grain)),
        [&](const Range& part) { body.forLoop(part.begin(), part.end()); }, tbb::simple_partitioner());
  });
}

btScalar TbbScheduler::parallelSum(int begin, int end, int grain, const btIParallelSumBody& body) {
  return arena_.execute([&] {
    return tbb::parallel_deterministic_reduce(
        Range(begin, end, static_cast<std::size_t>(grain)), btScalar(0),
        [&](const Range& part, btScalar sum) { return sum + body.sumLoop(part.begin(), part.end()); }, std::plus<>());
  });
}

void useThreads(int threads) {
  static TbbScheduler scheduler(1);
  scheduler.setNumThreads(threads);
  btSetTaskScheduler(&scheduler);
}

}  // namespace cairn::scenes
