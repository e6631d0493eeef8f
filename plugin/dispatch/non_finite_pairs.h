// SPDX-License-Identifier: Zlib
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// Pairs of bodies whose place, speed or force is no number: counts them, tells the user once, and settles those that
/// Bullet does not ask about. `count` may be called from several threads.
class NonFinitePairs {
 public:
  /// One more in this step.
  void count();
  /// How many were counted since this was asked last.
  std::uint32_t takeCount() { return count_.exchange(0); }

  /// This pair is of a compound's child: Bullet may keep its points without asking about it.
  void watch(TreePair& pair) { ofCompounds_.push_back(&pair); }
  /// It is destroyed.
  void forget(TreePair& pair);
  /// Settles watched pairs that have points of broken bodies; returns how many. What is collected in this step settles
  /// itself, unless `alsoCollected`. Users' callbacks are told of contacts that end, and may remove bodies.
  std::uint32_t cullLeftOvers(bool alsoCollected);

 private:
  void tell();

  std::atomic<std::uint32_t> count_{0};
  std::atomic<bool> hasWarned_{false};
  std::vector<TreePair*> ofCompounds_;
  std::vector<TreePair*> leftOvers_;  // of these, while they are settled; null: destroyed since
};

}  // namespace cairn::bullet
