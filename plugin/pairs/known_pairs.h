// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "colliders/collider.h"
#include "contacts/normal_clusters.h"
#include "contacts/reduction.h"
#include "platform/prefetch.h"

namespace cairn::bullet {

/// The leaf pairs that were in contact last, and their contacts now: the knowledge about a pair whose traversal is
/// unfinished.
class KnownPairs {
 public:
  /// The deepest contacts that Bullet did not get fill the list up to this number. Together with those that Bullet got,
  /// it bounds the work of a pair without a budget.
  static constexpr std::size_t kMax = 32;
  static constexpr std::size_t kMaxOfAll = kMax + kMaxClusters * kMaxPoints;

  // Reserved at once: bodies may roll for minutes before a pair knows as many contacts as it can.
  KnownPairs() { pairs_.reserve(kMaxOfAll); }

  void reset();
  /// Forgets the pairs, but keeps their contacts.
  void forgetPairs() { pairs_.clear(); }
  std::vector<NodePair>& pairs() { return pairs_; }
  const std::vector<NodePair>& pairs() const { return pairs_; }
  /// Bullet got a contact of this leaf pair.
  void remember(const NodePair& leaves);
  /// Fills the list up with the deepest contacts that were not chosen, for steps that may be interrupted. Reorders
  /// `contacts`.
  void rememberDeepest(const Collider& collider, std::vector<Contact>& contacts);
  /// Allocates the memory that only interruptible steps need, once.
  void makeRoom() { retested_.reserve(kMaxOfAll); }

  /// From now on their contacts are those of an earlier step.
  void beginStep() { isRetested_ = false; }
  /// Measures the known pairs again, once a step. `all`: working memory.
  void retest(Collider& collider, Budget& budget, std::vector<Contact>& all);
  bool isRetested() const { return isRetested_; }
  std::span<const Contact> contacts() const { return retested_; }

  /// Prefetches the list.
  void prefetchData() const { prefetch(pairs_.data(), pairs_.size() * sizeof(NodePair)); }

 private:
  // A flat leaf usually touches with its four corners.
  static constexpr std::size_t kMaxRetested = 4 * kMaxOfAll;

  std::vector<NodePair> pairs_;
  std::vector<Contact> retested_;  // at most `kMaxRetested`
  bool isRetested_ = false;
};

}  // namespace cairn::bullet
