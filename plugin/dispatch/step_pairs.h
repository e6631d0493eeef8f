// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "cairn/core/priority.h"
#include "cairn/core/tree_pair_traversal.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// The pairs of a step that wait for an answer, and what the scheduler is told of each.
class StepPairs {
 public:
  void reserve(std::size_t pairs);
  void clear();
  void add(TreePair& pair);
  std::span<TreePair* const> list() const { return pairs_; }
  /// Drops what was destroyed meanwhile, names what is new and puts all in the order of their names. Their places stay
  /// from here on.
  void order();

  std::size_t size() const { return pairs_.size(); }
  /// Null: finished, or destroyed after it was collected.
  TreePair* operator[](std::size_t index) const { return pairs_[index]; }
  /// The one so many places on; null where there is none.
  TreePair* after(std::size_t index, std::size_t ahead) const {
    return index + ahead < pairs_.size() ? pairs_[index + ahead] : nullptr;
  }
  /// Has the machine fetch what those that come after it need as they are begun.
  void prefetchAfter(std::size_t index) const;
  std::size_t waiting() const;
  /// It needs nothing more in this step.
  void dismiss(std::size_t index);
  /// It gets no turns until it is scheduled again.
  void unschedule(std::size_t index) { scheduled_[index].traversal = &nothing_; }
  std::span<ScheduledPair> scheduled() { return scheduled_; }

  std::uint64_t nameOf(std::size_t index) const { return scheduled_[index].id; }
  /// The first whose name is not below this one; the size where all are.
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
  std::vector<Named> named_;              // the same: sorted without a look at the pairs
  std::vector<ScheduledPair> scheduled_;  // one for each pair, once they are in order
  TreePairTraversal nothing_;             // stands for the traversals of pairs that are finished or gone
  std::uint64_t nextName_ = 0;
};

}  // namespace cairn::bullet
