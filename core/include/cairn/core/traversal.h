// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>

#include "cairn/core/budget.h"
#include "cairn/core/pair_list.h"
#include "cairn/core/sphere_tree.h"

namespace cairn {

enum class Progress : std::uint8_t { done, budgetSpent };

/// An interruptible breadth-first traversal (thesis 2.7.1), owned by whoever wants its answer.
///
/// `refine` works until it is done or the budget refuses a step; called again it goes on where it stopped, and any way
/// of cutting the work into calls gives the same bits. At every stop the answer is `front() + leafPairs()`: everything
/// that can touch lies in one of these pairs. No allocation once the lists have reached their working size.
class Traversal {
 public:
  virtual ~Traversal() = default;

  virtual Progress refine(Budget& budget) = 0;

  /// Forgets everything: done, with no pairs, and no tree or obstacle is looked at any more until the next start.
  void abandon();

  bool done() const { return head_ == queue_.size(); }
  /// Pairs found overlapping but not yet refined, oldest first.
  std::span<const NodePair> front() const { return queue_.pairs().subspan(head_); }
  /// Fully resolved pairs, in the order they were found.
  std::span<const NodePair> leafPairs() const { return leafPairs_.pairs(); }

  /// Certified bound, in world length, on how far apart the two surfaces of a pair can be although the pair is
  /// reported.
  virtual float pairError(const NodePair& pair) const = 0;
  /// Worst `pairError` over front and leaf pairs; 0 when there are none. Linear in both.
  float worstError() const;
  /// Worst `pairError` over the front alone: what going on could still improve.
  float worstFrontError() const;

 protected:
  Traversal() = default;
  Traversal(const Traversal&) = default;
  Traversal(Traversal&&) = default;
  Traversal& operator=(const Traversal&) = default;
  Traversal& operator=(Traversal&&) = default;

  PairList queue_;  // [0, head_) has been refined
  std::size_t head_ = 0;
  PairList leafPairs_;
};

}  // namespace cairn
