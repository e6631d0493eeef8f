// SPDX-License-Identifier: Zlib
#include "dispatch/left_behind.h"

#include <mutex>
#include <utility>
#include <vector>

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

namespace {

struct LeftBehind {
  std::mutex mutex;
  std::vector<std::shared_ptr<NarrowPhase::Impl>> all;
};

// Never destroyed: worlds may outlive every static object.
LeftBehind& leftBehind() {
  static auto* const left = new LeftBehind;
  return *left;
}

template <class Host>
void takeAway(Host& host) {
  const std::lock_guard lock(leftBehind().mutex);
  std::erase_if(leftBehind().all, [&](const auto& narrowPhase) { return narrowPhase->undoOn(host); });
}

}  // namespace

void leaveBehind(std::shared_ptr<NarrowPhase::Impl> narrowPhase) {
  const std::lock_guard lock(leftBehind().mutex);
  leftBehind().all.push_back(std::move(narrowPhase));
}

void takeAwayLeftBehind(btCollisionDispatcher& dispatcher) {
  takeAway(dispatcher);
}

void takeAwayLeftBehind(btCollisionWorld& world) {
  takeAway(world);
}

}  // namespace cairn::bullet
