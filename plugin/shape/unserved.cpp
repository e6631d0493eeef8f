// SPDX-License-Identifier: Zlib
#include "shape/unserved.h"

#include <algorithm>

#include "cairn/core/log.h"

namespace cairn::bullet {

namespace {

// Small moves in a row before the warning: more than a program makes that only places bodies, less than a second.
constexpr int kMoves = 8;
// Largest small move, as a fraction of the size. Placing bodies beside each other moves the pose by the size at least.
constexpr btScalar kSmall = btScalar(0.5);
// Largest number of boxes at other poses before another pose is watched. It doubles each time, because a shape may have
// any number of bodies.
constexpr int kMaxPatience = 1 << 16;

void tellOnce() {
  static std::atomic<bool> hasTold{false};
  if (hasTold.exchange(true)) return;
  logMessage(
      "a body with a sphere-tree moves in a world that knows none, and falls through most of what it meets: make the "
      "world's dispatcher a cairn::bullet::Dispatcher<>, or call cairn::bullet::install(world) (said once)");
}

}  // namespace

std::atomic<int>& servingDispatchers() {
  static std::atomic<int> count{0};
  return count;
}

void UnservedWatch::look(const btTransform& pose, btScalar size) {
  if (isLooking_.test_and_set(std::memory_order_acquire)) return;
  const bool isSame = watched_ == &pose;
  if (isSame) {
    const btScalar moved = pose.getOrigin().distance(last_);
    moves_ = moved < kSmall * size ? moves_ + (moved > 0 ? 1 : 0) : 0;
  }
  if (isSame || watched_ == nullptr || ++others_ > patience_) {
    if (!isSame) {
      moves_ = 0;
      patience_ = std::min(2 * patience_, kMaxPatience);
    }
    watched_ = &pose;
    last_ = pose.getOrigin();
    others_ = 0;
  }
  if (moves_ >= kMoves) tellOnce();
  isLooking_.clear(std::memory_order_release);
}

}  // namespace cairn::bullet
