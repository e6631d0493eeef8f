// SPDX-License-Identifier: Zlib
#include "dispatch/workers.h"

#include <algorithm>

namespace cairn::bullet {

void Workers::begin() {
  const btITaskScheduler* const scheduler = btGetTaskScheduler();
  count_ = scheduler ? static_cast<std::size_t>(std::max(scheduler->getNumThreads(), 1)) : 1;
  while (scratch_.size() < count_) scratch_.push_back(std::make_unique<ContactScratch>());
}

void Workers::forget() {
  for (const std::unique_ptr<ContactScratch>& scratch : scratch_) scratch->chosen.clear();
}

}  // namespace cairn::bullet
