// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include <atomic>

namespace cairn::bullet {

/// How many dispatchers of this program know sphere-trees; of those that are gone no more.
std::atomic<int>& servingDispatchers();

/// Notices a body that moves in a world where nobody knows sphere-trees, and says so on standard error, once a program:
/// Bullet itself has no algorithm for most of what a tree can meet, and lets it fall through without a word. A world
/// asks for the box of a body at the body's own transform, in every step, where it has moved a little.
class UnservedWatch {
 public:
  /// The box was asked for at `pose`, which is compared and, while it is here, read. Cost: nothing once somebody
  /// serves.
  void see(const btTransform& pose, btScalar size) {
    if (servingDispatchers().load(std::memory_order_relaxed) == 0) look(pose, size);
  }

 private:
  void look(const btTransform& pose, btScalar size);

  std::atomic_flag isLooking_ = ATOMIC_FLAG_INIT;  // several threads may cast
  const btTransform* watched_ = nullptr;           // only compared
  btVector3 last_{0, 0, 0};
  int moves_ = 0;
  int others_ = 0;  // asked about since it moved
  int patience_ = 8;
};

}  // namespace cairn::bullet
