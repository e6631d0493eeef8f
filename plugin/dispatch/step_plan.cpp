// SPDX-License-Identifier: Zlib
#include "dispatch/step_plan.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/scheduler.h"
#include "dispatch/step_tuning.h"
#include "memory/written_room.h"

namespace cairn::bullet {

namespace {

// Of what a pair is expected to take: with less than this left it is not begun.
constexpr double kLeastShare = 0.5;

// With less time left than such a pair takes none is begun, where that may be.
constexpr std::uint64_t kFewestOperations = 2 * Scheduler::kTurnOperations;

// And the least is one part of it.
constexpr double kMostImportant = 1e6;

void spend(StepMeans& left, double operations, double nanoseconds) {
  left.operations -= operations;
  left.nanoseconds -= nanoseconds;
}

// What needs nothing takes no time either.
double nanosecondsFor(const PairNeed& need, const EmissionPace& pace) {
  return need.operations > 0 ? pace.expectedNanoseconds(need.operations) : 0;
}

}  // namespace

bool StepPlan::isLessUrgent(std::size_t x, std::size_t y) const {
  return needs_[x].urgency != needs_[y].urgency ? needs_[x].urgency < needs_[y].urgency : x > y;
}

void StepPlan::reserve(std::size_t pairs) {
  makeWrittenRoom(needs_, pairs);
  makeWrittenRoom(heap_, pairs);
  makeWrittenRoom(chosen_, pairs);
  makeWrittenRoom(coarse_, pairs);
}

void StepPlan::clear() {
  needs_.clear();
  heap_.clear();
  chosen_.clear();
  coarse_.clear();
  coarseOperations_ = 0;
  isScarce_ = servesAny_ = false;
}

bool StepPlan::isTooMuchFor(StepMeans left, const EmissionPace& pace) const {
  for (const PairNeed& need : needs_) spend(left, static_cast<double>(need.operations), nanosecondsFor(need, pace));
  return left.operations < 0 || left.nanoseconds < 0;
}

void StepPlan::weigh(std::size_t pair, double importance) {
  const double counted = importance > 1 / kMostImportant ? std::min(importance, kMostImportant) : 1 / kMostImportant;
  needs_[pair].urgency *= std::sqrt(counted);
}

void StepPlan::decide(StepMeans left, const EmissionPace& pace, const EmissionPace& holdingPace, bool mayServeNone) {
  isScarce_ = isTooMuchFor(left, pace);
  if (!isScarce_) return;
  for (PairNeed& need : needs_) need.operations = std::min(need.operations, need.operationsIfScarce);
  holdAllThatCanBe(left, pace, holdingPace);
  chooseCoarse(left, pace);
  std::make_heap(heap_.begin(), heap_.end(), [&](std::size_t x, std::size_t y) { return isLessUrgent(x, y); });
  const bool mustServe = !mayServeNone || left.nanoseconds >= pace.expectedNanoseconds(kFewestOperations);
  chooseMostUrgent(left, pace, mustServe ? 1 : 0);
}

// A turn each, or as much as there is; where that is too little for all, none of those that can be held. Where the step
// ends at a time, a whole turn: what a look takes besides its operations is most of a shorter one.
void StepPlan::chooseCoarse(StepMeans& left, const EmissionPace& pace) {
  if (coarse_.empty()) return;
  const StepMeans share{left.operations * step_tuning::kCoarseShare, left.nanoseconds * step_tuning::kCoarseShare};
  const auto fits = [&](std::uint64_t operations) {
    const auto pairs = static_cast<double>(coarse_.size());
    return static_cast<double>(operations) * pairs <= share.operations &&
           pace.expectedNanoseconds(operations) * pairs <= share.nanoseconds;
  };
  const bool isTimed = !std::isinf(left.nanoseconds);
  if (!fits(isTimed ? Scheduler::kTurnOperations : Scheduler::kStepOperations)) holdCoarse();
  const double turns = static_cast<double>(Scheduler::kTurnOperations * coarse_.size());
  const double operations = std::clamp(share.operations, 0.0, turns);
  coarseOperations_ = static_cast<std::uint64_t>(operations);
  const double each = coarse_.empty() ? 0 : operations / static_cast<double>(coarse_.size());
  spend(left, operations,
        static_cast<double>(coarse_.size()) * pace.expectedNanoseconds(static_cast<std::uint64_t>(each)));
}

void StepPlan::holdCoarse() {
  std::erase_if(coarse_, [&](std::size_t i) {
    if (!needs_[i].canBeHeld) return false;
    if (sharesTheRest(i)) heap_.push_back(i);
    return true;
  });
}

bool StepPlan::decideOnMore(StepMeans left, const EmissionPace& pace) {
  chosen_.clear();
  if (heap_.empty()) return false;
  const bool mayCut = needs_[heap_.front()].mayBeCut && fits(heap_.front(), left, pace, kLeastShare);
  chooseMostUrgent(left, pace, mayCut ? 1 : 0);
  return !chosen_.empty();
}

void StepPlan::holdAllThatCanBe(StepMeans& left, const EmissionPace& pace, const EmissionPace& holdingPace) {
  for (std::size_t i = 0; i < needs_.size(); ++i) {
    const PairNeed& need = needs_[i];
    if (need.isUnanswered) coarse_.push_back(i);
    if (!sharesTheRest(i)) (need.canBeHeld ? heap_ : chosen_).push_back(i);
    if (need.canBeHeld)
      spend(left, static_cast<double>(kHoldingCost), holdingPace.expectedNanoseconds(0));
    else if (!need.isUnanswered)
      spend(left, static_cast<double>(need.operations), nanosecondsFor(need, pace));
  }
}

bool StepPlan::fits(std::size_t pair, const StepMeans& left, const EmissionPace& pace, double share) const {
  return left.operations >= share * static_cast<double>(needs_[pair].operations) &&
         left.nanoseconds >= share * nanosecondsFor(needs_[pair], pace);
}

void StepPlan::chooseMostUrgent(StepMeans& left, const EmissionPace& pace, std::size_t atLeast) {
  const auto isLess = [&](std::size_t x, std::size_t y) { return isLessUrgent(x, y); };
  for (std::size_t count = 0; !heap_.empty(); ++count) {
    const std::size_t pair = heap_.front();
    if (count >= atLeast && !fits(pair, left, pace, 1)) return;
    chosen_.push_back(pair);
    servesAny_ = true;
    spend(left, static_cast<double>(needs_[pair].operations), nanosecondsFor(needs_[pair], pace));
    std::pop_heap(heap_.begin(), heap_.end(), isLess);
    heap_.pop_back();
  }
}

}  // namespace cairn::bullet
