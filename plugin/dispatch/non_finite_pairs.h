// SPDX-License-Identifier: Zlib
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// Pairs with a non-finite body: counts them, warns the user once, and culls those that Bullet does not ask about.
/// Several threads may call `count`.
class NonFinitePairs {
 public:
  /// Counts one pair in this step.
  void count();
  /// Returns the count since the last call.
  std::uint32_t takeCount() { return count_.exchange(0); }

  /// Watches a pair of a compound's child: Bullet may keep its points without asking about it.
  void watch(TreePair& pair) { ofCompounds_.push_back(&pair); }
  /// The pair is destroyed.
  void forget(TreePair& pair);
  /// Culls watched pairs that have points of non-finite bodies, and returns their number. Pairs collected in this step
  /// cull themselves, unless `alsoCollected`. Users' callbacks see contacts that end, and may remove bodies.
  std::uint32_t cullLeftOvers(bool alsoCollected);

 private:
  void warn();

  std::atomic<std::uint32_t> count_{0};
  std::atomic<bool> hasWarned_{false};
  std::vector<TreePair*> ofCompounds_;
  std::vector<TreePair*> leftOvers_;  // the watched pairs being culled; null: destroyed since
};

}  // namespace cairn::bullet
