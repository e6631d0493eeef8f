// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <map>
#include <utility>

namespace cairn::scenes {

/// Which pairs of bodies press on each other: the sum of the impulses the solver last applied to all their contacts, N
/// s.
///
/// It has to be followed step by step: when bodies fall asleep, shapes that make their contacts anew every step
/// (GImpact) are left with contacts the solver never saw. A pair asleep keeps what it had when it was last solved.
class ContactLoads {
 public:
  /// To be called after each step. Bodies are told apart by Bullet's user index.
  void update(const btCollisionDispatcher& dispatcher);

  /// 0 for a pair without contacts; the order does not matter.
  double between(int first, int second) const;
  bool isLoaded(int first, int second) const { return between(first, second) > 0; }

 private:
  using Pair = std::pair<int, int>;  // smaller first
  std::map<Pair, double> loads_;
};

}  // namespace cairn::scenes
