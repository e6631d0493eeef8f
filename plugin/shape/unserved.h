// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include <atomic>

namespace cairn::bullet {

/// Number of live dispatchers of this program that know sphere-trees.
std::atomic<int>& servingDispatchers();

/// Detects a body that moves in a world without a dispatcher for sphere-trees, and warns once a program on standard
/// error. Bullet has no algorithm for most pairs of such a body, and lets it fall through in silence. A world asks for
/// the box of a body at the body's own transform in every step, so small moves of that transform show a moving body.
class UnservedWatch {
 public:
  /// A box was asked for at `pose`. Reads the pose now and later only compares its address. Cost: one load when a
  /// dispatcher serves.
  void see(const btTransform& pose, btScalar size) {
    if (servingDispatchers().load(std::memory_order_relaxed) == 0) look(pose, size);
  }

 private:
  void look(const btTransform& pose, btScalar size);

  std::atomic_flag isLooking_;            // several threads may cast
  const btTransform* watched_ = nullptr;  // only compared
  btVector3 last_{0, 0, 0};
  int moves_ = 0;
  int others_ = 0;  // boxes at other poses since then
  int patience_ = 8;
};

}  // namespace cairn::bullet
