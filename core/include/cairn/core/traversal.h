// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "cairn/core/export.h"
#include "cairn/core/pair_list.h"
#include "cairn/core/sphere_tree.h"

namespace cairn {

/// Why a traversal stopped: nothing is left to refine, or the budget refused a step.
enum class Progress : std::uint8_t { done, budgetSpent };

/// Factor on world length per tree unit that keeps certified errors upper bounds under rounding. This product, its
/// product with an error and the sum of two errors each round down by at most 2^-24 of themselves; 2^-21 is more than
/// all of them together.
inline constexpr double kErrorGrowth = 1 + 0x1p-21;

/// An interruptible breadth-first traversal (thesis 2.7.1), owned by whoever wants its answer.
///
/// `refine` works until it is done or the budget refuses a step; called again it goes on where it stopped, and any way
/// of cutting the work into calls gives the same bits. At every stop the answer is `front() + leafPairs()`: everything
/// that can touch lies in one of these pairs. No allocation once the lists have reached their working size.
class CAIRN_CORE_EXPORT Traversal {
 public:
  virtual ~Traversal() = default;

  /// Goes on until it is done or the budget refuses a step.
  virtual Progress refine(Budget& budget) = 0;

  /// Forgets everything: done, with no pairs, and no tree or obstacle is looked at any more until the next start.
  void abandon();
  /// Frees memory that is not in use; nothing else changes. Going on allocates again.
  void shrinkToFit();

  /// Whether nothing is left to refine.
  bool done() const { return head_ == queue_.size(); }
  /// Pairs found overlapping but not yet refined, oldest first.
  std::span<const NodePair> front() const { return queue_.pairs().subspan(head_); }
  /// A front of so many pairs at most is coarse: a step writes what it says within its budget. With 32, errors do not
  /// fall with the budget (`CoarseLook.ErrsLessTheMoreItIsGiven`); without a bound, steps take more than they have
  /// (`HeldPairs.ThatCostMoreThanAStepHasStayWithinItOnceAnswered`).
  static constexpr std::size_t kCoarsePairs = 128;
  /// The front, or where that is no longer coarse, what it was when a call of `refine` last began with a coarse one:
  /// with the leaf pairs these, too, hold everything that can touch. Bounds what an unfinished answer costs. None where
  /// it never was coarse.
  std::span<const NodePair> coarseFront() const;
  /// Fully resolved pairs, in the order they were found.
  std::span<const NodePair> leafPairs() const { return leafPairs_.pairs(); }

  /// Whether the spheres of a reported pair touch, as its bounds did when it was found. False proves that nothing of
  /// its regions does. Always true in trees of one sphere a node. Cost: an update and a test, which is not charged.
  virtual bool mayTouch(const NodePair& pair) const = 0;
  /// Certified bound, in world length, on how far apart the solids below the two nodes of a pair can be although the
  /// pair is reported and may touch. Of surfaces it says that only where neither body lies wholly inside the other.
  virtual float pairError(const NodePair& pair) const = 0;
  /// Worst `pairError` of these pairs, 0 for none. To be overridden only to be faster.
  virtual float worstOf(std::span<const NodePair> pairs) const;
  /// Worst `pairError` over front and leaf pairs; 0 when there are none. Linear in both.
  float worstError() const;
  /// Worst `pairError` over the front alone: what going on could still improve. Exact, and looks at every pair found
  /// only once, however often it is asked: constant cost a pair, amortised.
  float worstFrontError();

 protected:
  Traversal() = default;
  Traversal(const Traversal&) = default;
  Traversal(Traversal&&) = default;
  Traversal& operator=(const Traversal&) = default;
  Traversal& operator=(Traversal&&) = default;

  /// To be called as `refine` begins.
  void noteFront();
  /// `pairError` may answer differently from now on.
  void forgetErrors();

  PairList queue_;        ///< pairs found overlapping; those before `head_` have been refined
  std::size_t head_ = 0;  ///< the first pair of `queue_` that is still to be refined
  PairList leafPairs_;    ///< what `leafPairs` returns

 private:
  // The greatest error of a queue that only grows behind and shrinks in front: of the pairs seen, a few at a time,
  // those chunks with no later one as bad, oldest and worst first.
  struct Peak {
    std::size_t begin, end;  // in the queue
    float error;
  };
  std::size_t coarseBegin_ = 0, coarseEnd_ = 0;  // in the queue
  static constexpr std::size_t kChunk = 8;
  std::vector<Peak> peaks_;
  std::size_t firstPeak_ = 0;  // those before it have been refined
  std::size_t seen_ = 0;       // places of the queue looked at
};

}  // namespace cairn
