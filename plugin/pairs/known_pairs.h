// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "colliders/collider.h"
#include "contacts/normal_clusters.h"
#include "contacts/reduction.h"
#include "memory/prefetch.h"

namespace cairn::bullet {

/// The resolved pairs that were in contact last, and what these say now: what is known while a traversal is unfinished.
class KnownPairs {
 public:
  /// To so many they are topped up with what was not handed to Bullet. Bounds, with what was, the work of a pair that
  /// gets no budget.
  static constexpr std::size_t kMax = 32;
  static constexpr std::size_t kMaxOfAll = kMax + kMaxClusters * kMaxPoints;

  // Bodies may roll for minutes before as much is known of a pair as can be.
  KnownPairs() { pairs_.reserve(kMaxOfAll); }

  void reset();
  /// Forgets the pairs, not what they said.
  void forgetPairs() { pairs_.clear(); }
  std::vector<NodePair>& pairs() { return pairs_; }
  const std::vector<NodePair>& pairs() const { return pairs_; }
  /// A contact of these was handed to Bullet.
  void remember(const NodePair& leaves);
  /// Tops them up with the deepest of the contacts that were not chosen, for steps that may be interrupted.
  /// Reorders the contacts.
  void rememberDeepest(const Collider& collider, std::vector<Contact>& contacts);
  /// Allocates, once, what only steps that may be interrupted need.
  void makeRoom() { retested_.reserve(kMaxOfAll); }

  /// What they say is of an earlier step.
  void beginStep() { isRetested_ = false; }
  /// Asks them, once a step; `all`: working memory.
  void retest(Collider& collider, Budget& budget, std::vector<Contact>& all);
  bool isRetested() const { return isRetested_; }
  std::span<const Contact> contacts() const { return retested_; }

  /// See `prefetch`.
  void prefetchData() const { prefetch(pairs_.data(), pairs_.size() * sizeof(NodePair)); }

 private:
  // A flat leaf touches with its corners, four as a rule.
  static constexpr std::size_t kMaxRetested = 4 * kMaxOfAll;

  std::vector<NodePair> pairs_;
  std::vector<Contact> retested_;  // at most `kMaxRetested`, whatever each known pair has to say
  bool isRetested_ = false;
};

}  // namespace cairn::bullet
