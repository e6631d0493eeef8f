// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cairn/core/budget.h"
#include "pairs/cost_model.h"
#include "pairs/pair_estimate.h"

namespace cairn::bullet {

/// What a step has left for its pairs.
struct StepMeans {
  double operations = std::numeric_limits<double>::infinity();
  double nanoseconds = std::numeric_limits<double>::infinity();
};

/// Decides what the pairs of a step get when there is not enough for all. Those that have nothing to say share a part
/// of it: each is looked at coarsely before any gets all, where that is enough for each. Of the others the most urgent
/// are brought up to date, as many as can be expected to be finished; the rest is held: their contacts follow the
/// bodies. See docs/algorithms/narrow-phase.md.
class StepPlan {
 public:
  /// What holding a pair is charged: as much as moving a sphere.
  static constexpr std::uint64_t kCarryOverOperations = kSphereUpdateCost;

  /// Room for so many pairs.
  void reserve(std::size_t pairs);
  void clear();
  void add(const PairEstimate& estimate) { estimates_.push_back(estimate); }
  /// Whether `left` is too little for all of them.
  bool isTooMuchFor(StepMeans left, const CostModel& cost) const;
  /// How much a pair matters (`Priority::importance`): its urgency is multiplied by the square root of that, because
  /// what is neglected too long costs the others: its answer lapses, its bodies never come to rest. Less than a
  /// millionth, and what is not a number, counts as that, more than a million as a million: no pair waits for ever.
  void weigh(std::size_t pair, double importance);

  /// Decides about the pairs added. What cannot be held is brought up to date in any case, and of the rest at least
  /// one; with `mayServeNone` none where holding them leaves no time for a turn or two. `cost` says how long operations
  /// take. Ties: who was added first. Linear in the pairs, and n log n in those that are brought up to date; no
  /// allocation once it has seen as many pairs.
  void decide(StepMeans left, const CostModel& cost, const CostModel& carryOverCost, bool mayServeNone = false);
  /// When those chosen took less than expected: chooses more, with what is `left` besides holding the rest; one that
  /// does not quite fit if no other does. False when that is too little for any.
  bool decideOnMore(StepMeans left, const CostModel& cost);

  /// Whether pairs may have to be held.
  bool isScarce() const { return isScarce_; }
  /// Whether none of those that can be held is chosen.
  bool servesNone() const { return isScarce_ && !servesAny_; }
  /// Those to be looked at coarsely, all of them together with so many operations: some of the chosen are among them.
  std::span<const std::size_t> coarse() const { return coarse_; }
  std::uint64_t coarseOperations() const { return coarseOperations_; }
  /// Whether one of these shares with the chosen what is left then: finishing it alone would make no answer that lasts,
  /// or it cannot be held.
  bool sharesTheRest(std::size_t pair) const {
    const PairEstimate& estimate = estimates_[pair];
    return estimate.isUnanswered && (estimate.outrunsAnswers || !estimate.canBeCarriedOver);
  }
  /// Those last chosen.
  std::span<const std::size_t> chosen() const { return chosen_; }
  /// Those still held, in no order.
  std::span<const std::size_t> carriedOver() const { return heap_; }

 private:
  bool isLessUrgent(std::size_t x, std::size_t y) const;
  void chooseCoarse(StepMeans& left, const CostModel& cost);
  void carryOverCoarse();
  void carryOverAllThatCanBe(StepMeans& left, const CostModel& cost, const CostModel& carryOverCost);
  bool fits(std::size_t pair, const StepMeans& left, const CostModel& cost, double share) const;
  void chooseMostUrgent(StepMeans& left, const CostModel& cost, std::size_t atLeast);

  std::vector<PairEstimate> estimates_;
  std::vector<std::size_t> heap_;  // of those that are held, the most urgent on top
  std::vector<std::size_t> chosen_;
  std::vector<std::size_t> coarse_;
  std::uint64_t coarseOperations_ = 0;
  bool isScarce_ = false;
  bool servesAny_ = false;
};

}  // namespace cairn::bullet
