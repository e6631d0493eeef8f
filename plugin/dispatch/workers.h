// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btThreads.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "pairs/pair_contacts.h"

namespace cairn::bullet {

/// The threads of Bullet's task scheduler (`btSetTaskScheduler`), each with its own working memory. Without a scheduler
/// the calling thread works alone, as in all of Bullet's worlds except `btDiscreteDynamicsWorldMt`.
class Workers {
 public:
  /// Adopts the scheduler's present number of threads.
  void begin();
  std::size_t count() const { return count_; }
  /// Clears the contacts that any thread chose for manifolds.
  void forget();
  /// The calling thread's working memory, while no loop runs.
  ContactScratch& own() { return *scratch_.front(); }
  /// Calls `work(scratch, i)` once for each `i` below `all`, in any order, on several threads. No two threads share a
  /// scratch. Returns when all calls have returned. No call may read data that another one writes.
  template <class Work>
  void forEach(std::size_t all, const Work& work);

 private:
  template <class Work>
  class Body;

  std::size_t count_ = 1;
  std::vector<std::unique_ptr<ContactScratch>> scratch_;  // one for each of the most threads so far
};

// Bullet's loop runs over workers, not over the work: a worker that is done takes the next item, and nobody waits for
// one with a harder share.
template <class Work>
class Workers::Body final : public btIParallelForBody {
 public:
  Body(const Workers& workers, std::size_t all, const Work& work) : workers_(workers), work_(work), all_(all) {}

  void forLoop(int begin, int end) const override {
    for (int worker = begin; worker < end; ++worker) workOn(*workers_.scratch_[static_cast<std::size_t>(worker)]);
  }

 private:
  void workOn(ContactScratch& scratch) const {
    for (std::size_t i = next_++; i < all_; i = next_++) work_(scratch, i);
  }

  const Workers& workers_;
  const Work& work_;
  const std::size_t all_;
  mutable std::atomic<std::size_t> next_{0};
};

template <class Work>
void Workers::forEach(std::size_t all, const Work& work) {
  const Body<Work> body(*this, all, work);
  if (count_ > 1 && all > 1)
    btGetTaskScheduler()->parallelFor(0, static_cast<int>(count_), 1, body);
  else
    body.forLoop(0, 1);
}

}  // namespace cairn::bullet
