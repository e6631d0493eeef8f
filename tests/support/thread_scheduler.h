// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btThreads.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace cairn::test {

/// A task scheduler of Bullet's, also where Bullet itself knows no threads: makes new ones for each loop.
class ThreadScheduler final : public btITaskScheduler {
 public:
  explicit ThreadScheduler(int threads) : btITaskScheduler("threads of their own"), threads_(threads) {
    btSetTaskScheduler(this);
  }
  ~ThreadScheduler() override { btSetTaskScheduler(before_); }

  int getMaxNumThreads() const override { return 64; }
  int getNumThreads() const override { return threads_; }
  void setNumThreads(int threads) override { threads_ = threads; }
  void parallelFor(int begin, int end, int grain, const btIParallelForBody& body) override {
    ++loops;
    std::vector<std::thread> running;
    for (int first = begin; first < end; first += grain)
      running.emplace_back([&body, first, last = std::min(first + grain, end)] { body.forLoop(first, last); });
    for (std::thread& thread : running) thread.join();
  }
  btScalar parallelSum(int begin, int end, int, const btIParallelSumBody& body) override {
    return body.sumLoop(begin, end);
  }

  int loops = 0;  ///< so far

 private:
  btITaskScheduler* const before_ = btGetTaskScheduler();
  int threads_;
};

}  // namespace cairn::test
