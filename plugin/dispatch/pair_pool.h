// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "colliders/collider.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

using PairCounts = std::array<std::size_t, kColliderKinds>;

/// The states of all pairs. None is freed before this is: a pair that comes back costs no allocation, unless it rested.
class PairPool {
 public:
  /// An idle one, or a new one.
  TreePair* take(ColliderKind kind);
  /// Precondition: taken, and not given back since; without manifolds.
  void giveBack(TreePair& pair);
  /// Makes as many idle pairs of each kind as these, if there are fewer. Returns how many there are in all.
  std::size_t reserve(const PairCounts& pairs);
  /// Once a step: looks at some pairs, others in each, so that those that rest give memory back.
  void endStep();

 private:
  std::vector<std::unique_ptr<TreePair>> all_;
  std::array<std::vector<TreePair*>, kColliderKinds> idle_;
  std::size_t steps_ = 0;
};

}  // namespace cairn::bullet
