// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btThreads.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "pairs/pair_contacts.h"

namespace cairn::bullet {

/// The threads of Bullet's task scheduler (`btSetTaskScheduler`), each with working memory of its own. Where none is
/// set, as in Bullet's own worlds but `btDiscreteDynamicsWorldMt`, the calling thread works alone.
class Workers {
 public:
  /// Sees how many there are.
  void begin();
  std::size_t count() const { return count_; }
  /// What any of them chose for manifolds.
  void forget();
  /// The calling thread's, while no loop runs.
  ContactScratch& own() { return *scratch_.front(); }
  /// Calls `work(scratch, i)` once for each `i` below `all`, in any order, on several threads at a time; nobody else
  /// has the scratch meanwhile. Returns when all have returned. What one writes no other may read.
  template <class Work>
  void forEach(std::size_t all, const Work& work);

 private:
  template <class Work>
  class Body;

  std::size_t count_ = 1;
  std::vector<std::unique_ptr<ContactScratch>> scratch_;  // one for each of the most there have been
};

// Bullet's loop goes over workers, not over the work: who is done takes the next, and nobody waits for a worker whose
// share was the harder one.
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
