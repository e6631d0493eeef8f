// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <LinearMath/btThreads.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <memory>

namespace cairn::scenes {

/// Bullet's task scheduler on oneTBB. Bullet's own is for an older TBB, and Debian builds Bullet without any.
/// Sphere-trees need no more than this to be worked on by several threads; Bullet's own parts of a world stay on one.
class TbbScheduler final : public btITaskScheduler {
 public:
  /// Precondition: at least one thread.
  explicit TbbScheduler(int threads);
  ~TbbScheduler() override;

  int getMaxNumThreads() const override;
  int getNumThreads() const override { return arena_.max_concurrency(); }
  void setNumThreads(int threads) override;
  void parallelFor(int begin, int end, int grain, const btIParallelForBody& body) override;
  btScalar parallelSum(int begin, int end, int grain, const btIParallelSumBody& body) override;

 private:
  std::unique_ptr<oneapi::tbb::global_control> most_;  // of the process: also more than the machine has, never fewer
  oneapi::tbb::task_arena arena_;
};

/// Has this program's worlds work on so many threads from now on.
void useThreads(int threads);

}  // namespace cairn::scenes
