// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cairn/bullet/step.h"
#include "pairs/collider_kinds.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

using PairCounts = std::array<std::size_t, kColliderKinds>;
/// The same numbers by kind.
PairCounts countsByKind(const ExpectedPairs& pairs);

/// Owner of all pairs. It frees none before its own end: a pair that returns costs no allocation, unless it was at
/// rest.
class PairPool {
 public:
  /// Returns an idle pair, or a new one.
  TreePair* take(ColliderKind kind);
  /// Takes a pair back. Precondition: it was taken, not given back since, and has no manifolds.
  void giveBack(TreePair& pair);
  /// Makes idle pairs until there are as many of each kind as given. Returns the number of all pairs.
  std::size_t reserve(const PairCounts& pairs);
  /// Whether any pair is taken and not given back.
  bool hasTaken() const;
  /// The bodies of all taken pairs, sorted.
  std::vector<ServedPair> servedPairs() const;
  /// The last answers of taken pairs whose bodies were not found apart.
  std::vector<PairAnswered> lastAnswers() const;
  /// Called once a step: looks at some pairs in turn, so that pairs at rest give memory back.
  void endStep();

 private:
  std::vector<std::unique_ptr<TreePair>> all_;
  std::array<std::vector<TreePair*>, kColliderKinds> idle_;
  std::size_t steps_ = 0;
};

}  // namespace cairn::bullet
