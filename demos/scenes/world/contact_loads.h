// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <map>
#include <utility>

namespace cairn::scenes {

/// Finds the pairs of bodies that press on each other: the sum of the solver's last impulses at all their contacts, N
/// s.
///
/// It must be updated after every step. When bodies fall asleep, shapes with new contacts every step (GImpact) keep
/// contacts that the solver never saw. A sleeping pair keeps its load from the last step in which it was solved.
class ContactLoads {
 public:
  /// Call it after each step. Bullet's user index identifies bodies.
  void update(const btCollisionDispatcher& dispatcher);

  /// 0 for a pair without contacts; the order does not matter.
  double between(int first, int second) const;
  bool isLoaded(int first, int second) const { return between(first, second) > 0; }

 private:
  using Pair = std::pair<int, int>;  // smaller first
  std::map<Pair, double> loads_;
};

}  // namespace cairn::scenes
