// SPDX-License-Identifier: Zlib
#include "dispatch/step_plan.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/scheduler.h"
#include "dispatch/step_tuning.h"
#include "memory/written_room.h"

namespace cairn::bullet {

namespace {

// Minimum fraction of a pair's expected cost: with less left, the pair is not begun.
constexpr double kMinShare = 0.5;

// With less time left than such a pair takes, no pair is begun, where that is allowed.
constexpr std::uint64_t kMinOperations = 2 * Scheduler::kTurnOperations;

// The minimum weight is 1 / maximum.
constexpr double kMaxImportance = 1e6;

void spend(StepMeans& left, double operations, double nanoseconds) {
  left.operations -= operations;
  left.nanoseconds -= nanoseconds;
}

// A pair without operations takes no time.
double nanosecondsFor(const PairEstimate& estimate, const CostModel& cost) {
  return estimate.operations > 0 ? cost.expectedNanoseconds(estimate.operations) : 0;
}

}  // namespace

bool StepPlan::isLessUrgent(std::size_t x, std::size_t y) const {
  return estimates_[x].urgency != estimates_[y].urgency ? estimates_[x].urgency < estimates_[y].urgency : x > y;
}

void StepPlan::reserve(std::size_t pairs) {
  makeWrittenRoom(estimates_, pairs);
  makeWrittenRoom(heap_, pairs);
  makeWrittenRoom(chosen_, pairs);
  makeWrittenRoom(coarse_, pairs);
}

void StepPlan::clear() {
  estimates_.clear();
  heap_.clear();
  chosen_.clear();
  coarse_.clear();
  coarseOperations_ = 0;
  isScarce_ = servesAny_ = false;
}

bool StepPlan::isTooMuchFor(StepMeans left, const CostModel& cost) const {
  for (const PairEstimate& estimate : estimates_)
    spend(left, static_cast<double>(estimate.operations), nanosecondsFor(estimate, cost));
  return left.operations < 0 || left.nanoseconds < 0;
}

void StepPlan::weigh(std::size_t pair, double importance) {
  const double counted = importance > 1 / kMaxImportance ? std::min(importance, kMaxImportance) : 1 / kMaxImportance;
  estimates_[pair].urgency *= std::sqrt(counted);
}

void StepPlan::decide(StepMeans left, const CostModel& cost, const CostModel& carryOverCost, bool mayServeNone) {
  isScarce_ = isTooMuchFor(left, cost);
  if (!isScarce_) return;
  for (PairEstimate& estimate : estimates_)
    estimate.operations = std::min(estimate.operations, estimate.operationsIfScarce);
  carryOverAllThatCanBe(left, cost, carryOverCost);
  chooseCoarse(left, cost);
  std::make_heap(heap_.begin(), heap_.end(), [&](std::size_t x, std::size_t y) { return isLessUrgent(x, y); });
  const bool mustServe = !mayServeNone || left.nanoseconds >= cost.expectedNanoseconds(kMinOperations);
  chooseMostUrgent(left, cost, mustServe ? 1 : 0);
}

// A coarse look is a turn for each pair, or as much as there is. Where that is too little, pairs that can be carried
// over get none. Under a deadline it is a whole turn, because a shorter look costs mostly overhead.
void StepPlan::chooseCoarse(StepMeans& left, const CostModel& cost) {
  if (coarse_.empty()) return;
  const StepMeans share{left.operations * step_tuning::kCoarseShare, left.nanoseconds * step_tuning::kCoarseShare};
  const auto fits = [&](std::uint64_t operations) {
    const auto pairs = static_cast<double>(coarse_.size());
    return static_cast<double>(operations) * pairs <= share.operations &&
           cost.expectedNanoseconds(operations) * pairs <= share.nanoseconds;
  };
  const bool isTimed = !std::isinf(left.nanoseconds);
  if (!fits(isTimed ? Scheduler::kTurnOperations : Scheduler::kStepOperations)) carryOverCoarse();
  const double turns = static_cast<double>(Scheduler::kTurnOperations * coarse_.size());
  const double operations = std::clamp(share.operations, 0.0, turns);
  coarseOperations_ = static_cast<std::uint64_t>(operations);
  const double each = coarse_.empty() ? 0 : operations / static_cast<double>(coarse_.size());
  spend(left, operations,
        static_cast<double>(coarse_.size()) * cost.expectedNanoseconds(static_cast<std::uint64_t>(each)));
}

void StepPlan::carryOverCoarse() {
  std::erase_if(coarse_, [&](std::size_t i) {
    if (!estimates_[i].canBeCarriedOver) return false;
    if (sharesTheRest(i)) heap_.push_back(i);
    return true;
  });
}

bool StepPlan::decideOnMore(StepMeans left, const CostModel& cost) {
  chosen_.clear();
  if (heap_.empty()) return false;
  const bool mayCut = estimates_[heap_.front()].mayBeCut && fits(heap_.front(), left, cost, kMinShare);
  chooseMostUrgent(left, cost, mayCut ? 1 : 0);
  return !chosen_.empty();
}

void StepPlan::carryOverAllThatCanBe(StepMeans& left, const CostModel& cost, const CostModel& carryOverCost) {
  for (std::size_t i = 0; i < estimates_.size(); ++i) {
    const PairEstimate& estimate = estimates_[i];
    if (estimate.isUnanswered) coarse_.push_back(i);
    if (!sharesTheRest(i)) (estimate.canBeCarriedOver ? heap_ : chosen_).push_back(i);
    if (estimate.canBeCarriedOver)
      spend(left, static_cast<double>(kCarryOverOperations), carryOverCost.expectedNanoseconds(0));
    else if (!estimate.isUnanswered)
      spend(left, static_cast<double>(estimate.operations), nanosecondsFor(estimate, cost));
  }
}

bool StepPlan::fits(std::size_t pair, const StepMeans& left, const CostModel& cost, double share) const {
  return left.operations >= share * static_cast<double>(estimates_[pair].operations) &&
         left.nanoseconds >= share * nanosecondsFor(estimates_[pair], cost);
}

void StepPlan::chooseMostUrgent(StepMeans& left, const CostModel& cost, std::size_t atLeast) {
  const auto isLess = [&](std::size_t x, std::size_t y) { return isLessUrgent(x, y); };
  for (std::size_t count = 0; !heap_.empty(); ++count) {
    const std::size_t pair = heap_.front();
    if (count >= atLeast && !fits(pair, left, cost, 1)) return;
    chosen_.push_back(pair);
    servesAny_ = true;
    spend(left, static_cast<double>(estimates_[pair].operations), nanosecondsFor(estimates_[pair], cost));
    std::pop_heap(heap_.begin(), heap_.end(), isLess);
    heap_.pop_back();
  }
}

}  // namespace cairn::bullet
