// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <LinearMath/btThreads.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <memory>

namespace cairn::scenes {

/// Bullet's task scheduler on oneTBB. Bullet's own scheduler needs an older TBB, and Debian builds Bullet without any.
/// Sphere-trees need only this to use several threads. Bullet's own parts of a world stay on one thread.
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
  std::unique_ptr<oneapi::tbb::global_control>
      most_;  // raises the process's limit above the machine's cores if needed; never lowers it
  oneapi::tbb::task_arena arena_;
};

/// Sets the number of threads for this program's worlds from now on.
void useThreads(int threads);

}  // namespace cairn::scenes
