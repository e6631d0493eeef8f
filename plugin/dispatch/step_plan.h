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

/// What a step has left to spend on its pairs.
struct StepMeans {
  double operations = std::numeric_limits<double>::infinity();
  double nanoseconds = std::numeric_limits<double>::infinity();
};

/// Decides how a step divides a budget that is too small for all pairs. Pairs without an answer first share a part of
/// it: each gets a coarse look, where there is enough for each. Of the others, the most urgent are updated, as many as
/// can be finished. The rest is carried over. See docs/algorithms/narrow-phase.md.
class StepPlan {
 public:
  /// Operations charged for carrying a pair over: as many as for moving a sphere.
  static constexpr std::uint64_t kCarryOverOperations = kSphereUpdateCost;

  /// Reserves memory for this many pairs.
  void reserve(std::size_t pairs);
  void clear();
  void add(const PairEstimate& estimate) { estimates_.push_back(estimate); }
  /// Whether `left` is too little to update all pairs.
  bool isTooMuchFor(StepMeans left, const CostModel& cost) const;
  /// Multiplies a pair's urgency by the square root of its importance (`Priority::importance`). The root softens it,
  /// because pairs neglected too long cost the others: their answers lapse and their bodies stay awake. The importance
  /// is clamped to between a millionth and a million, NaN to a millionth, so that no pair waits for ever.
  void weigh(std::size_t pair, double importance);

  /// Decides about the added pairs. Pairs that cannot be carried over are always updated, and of the rest at least one.
  /// With `mayServeNone` it may be none, where carrying over leaves no time for a turn or two. Ties go to the pair
  /// added first. Cost: linear in the pairs, and n log n in those updated; no allocation in the steady state.
  void decide(StepMeans left, const CostModel& cost, const CostModel& carryOverCost, bool mayServeNone = false);
  /// Chooses more pairs when the chosen ones took less than expected. `left`: what remains besides carrying over the
  /// rest. A pair that does not quite fit is chosen if no other fits. False when there is too little for any.
  bool decideOnMore(StepMeans left, const CostModel& cost);

  /// Whether pairs may have to be carried over.
  bool isScarce() const { return isScarce_; }
  /// Whether none of the pairs that can be carried over is chosen.
  bool servesNone() const { return isScarce_ && !servesAny_; }
  /// The pairs to be looked at coarsely, with `coarseOperations` for all of them together. Some are among the chosen.
  std::span<const std::size_t> coarse() const { return coarse_; }
  std::uint64_t coarseOperations() const { return coarseOperations_; }
  /// Whether a pair with a coarse look also shares the rest with the chosen: it cannot be carried over, or an answer
  /// would not last.
  bool sharesTheRest(std::size_t pair) const {
    const PairEstimate& estimate = estimates_[pair];
    return estimate.isUnanswered && (estimate.outrunsAnswers || !estimate.canBeCarriedOver);
  }
  /// The pairs chosen last.
  std::span<const std::size_t> chosen() const { return chosen_; }
  /// The pairs still carried over, unordered.
  std::span<const std::size_t> carriedOver() const { return heap_; }

 private:
  bool isLessUrgent(std::size_t x, std::size_t y) const;
  void chooseCoarse(StepMeans& left, const CostModel& cost);
  void carryOverCoarse();
  void carryOverAllThatCanBe(StepMeans& left, const CostModel& cost, const CostModel& carryOverCost);
  bool fits(std::size_t pair, const StepMeans& left, const CostModel& cost, double share) const;
  void chooseMostUrgent(StepMeans& left, const CostModel& cost, std::size_t atLeast);

  std::vector<PairEstimate> estimates_;
  std::vector<std::size_t> heap_;  // pairs to carry over, the most urgent on top
  std::vector<std::size_t> chosen_;
  std::vector<std::size_t> coarse_;
  std::uint64_t coarseOperations_ = 0;
  bool isScarce_ = false;
  bool servesAny_ = false;
};

}  // namespace cairn::bullet
