// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "cairn/core/priority.h"
#include "cairn/core/tree_pair_traversal.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// The pairs of a step that wait for an answer, and their entries for the scheduler.
class StepPairs {
 public:
  void reserve(std::size_t pairs);
  void clear();
  void add(TreePair& pair);
  std::span<TreePair* const> list() const { return pairs_; }
  /// Drops destroyed pairs, names new ones and sorts all by name. Positions stay fixed from here on.
  void order();

  std::size_t size() const { return pairs_.size(); }
  /// A pair by position; null if it is finished or was destroyed after it was collected.
  TreePair* operator[](std::size_t index) const { return pairs_[index]; }
  /// The pair `ahead` positions later; null where there is none.
  TreePair* after(std::size_t index, std::size_t ahead) const {
    return index + ahead < pairs_.size() ? pairs_[index + ahead] : nullptr;
  }
  /// Prefetches the data of the pairs that are begun next.
  void prefetchAfter(std::size_t index) const;
  std::size_t waiting() const;
  /// The pair needs no more work in this step.
  void dismiss(std::size_t index);
  /// The pair gets no turns until it is scheduled again.
  void unschedule(std::size_t index) { scheduled_[index].traversal = &nothing_; }
  std::span<ScheduledPair> scheduled() { return scheduled_; }

  std::uint64_t nameOf(std::size_t index) const { return scheduled_[index].id; }
  /// Position of the first pair with at least this name; the size if there is none.
  std::size_t firstFrom(std::uint64_t name) const;

 private:
  struct NewPair {
    PairKey key;
    TreePair* pair;
  };

  struct Named {
    std::uint64_t id;
    TreePair* pair;
  };

  void nameNew();

  std::vector<TreePair*> pairs_;
  std::vector<NewPair> newPairs_;         // working memory of `order`
  std::vector<Named> named_;              // working memory of `order`: sorted without reading the pairs
  std::vector<ScheduledPair> scheduled_;  // one for each pair, in order
  TreePairTraversal nothing_;             // stands for traversals of pairs that are finished or gone
  std::uint64_t nextName_ = 0;
};

}  // namespace cairn::bullet
