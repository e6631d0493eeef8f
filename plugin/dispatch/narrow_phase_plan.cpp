// SPDX-License-Identifier: Zlib
// Which pairs of a step are brought up to date, and what becomes of the others.
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>
#include <utility>

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

StepMeans NarrowPhase::Impl::means() const {
  StepMeans means;
  if (left_.remaining() < kEndless) means.operations = static_cast<double>(left_.remaining());
  means.nanoseconds = left_.nanosecondsLeft();
  return means;
}

// Not while other policies than guards stand in: their answers cannot wait.
bool NarrowPhase::Impl::isPlanned() const {
  return mayBeInterrupted() && policy_ == Unresolved::guard;
}

void NarrowPhase::Impl::planStep() {
  plan_.clear();
  if (!isPlanned()) return;
  for (TreePair* pair : collected_) {
    if (!pair->is(PairStage::surveyed))
      survey(*pair, static_cast<std::uint64_t>(usualOperations_), left_.hasDeadline());
    plan_.add(carriesPairsOver() && bullet::mayBeCarriedOver(*pair) ? PairNeed() : pair->work.need);
  }
  if (priority_->hasImportances() && plan_.isTooMuchFor(means(), updatePace_))
    for (std::size_t i = 0; i < collected_.size(); ++i)
      if (!collected_[i]->isSettled()) plan_.weigh(i, priority_->importance(describe(*collected_[i])));
  const bool hasNoTime = stepLimit().microseconds == 0;  // nor any that is given all the same
  const bool mayServeNone = left_.hasDeadline() && (hasNoTime || stepsWithoutTurn_ < kMostStepsWithoutTurn);
  plan_.decide(means(), updatePace_, holdingPace_, mayServeNone);
}

void NarrowPhase::Impl::refinePairs() {
  promiseHolding();
  Progress progress = scheduler_.run(scheduled_, *priority_, left_, this);
  // What was promised to those that are done is more than triangles take.
  if (progress != Progress::done && finishResolvedPairs()) progress = resumePairs();
  while (plan_.isScarce() && progress == Progress::done) {
    StepMeans more = means();
    more.nanoseconds -= holding_.nanoseconds;
    if (!plan_.decideOnMore(more, updatePace_)) break;
    promiseHolding();
    for (const std::size_t i : plan_.chosen()) progress = serveAlone(i);
  }
  stepsWithoutTurn_ = plan_.servesNone() ? stepsWithoutTurn_ + 1 : 0;
}

Progress NarrowPhase::Impl::serveAlone(std::size_t index) {
  if (collected_[index]) beginPair(index);
  const bool isToBeRefined = collected_[index] && !collected_[index]->isDone();
  return isToBeRefined ? scheduler_.runAlone(scheduled_, index, left_, this) : Progress::done;
}

void NarrowPhase::Impl::promiseHolding() {
  left_.redeem(holding_);
  const std::size_t count = plan_.held().size();
  holding_.operations = std::min<std::uint64_t>(count * StepPlan::kHoldingCost, left_.remaining() / 2);
  holding_.nanoseconds = static_cast<double>(count) * holdingPace_.expectedNanoseconds(0);
  left_.promise(holding_);
}

// In the order of their names: callbacks may tell. But where time ran out the step before, what had to wait then comes
// first.
void NarrowPhase::Impl::holdPairs() {
  left_.redeem(std::exchange(holding_, {}));
  const auto isThere = [](const TreePair* pair) { return pair != nullptr; };
  auto waiting = static_cast<std::size_t>(std::ranges::count_if(collected_, isThere));
  auto began = Budget::Clock::now();
  double expected = 0;
  bool isLate = false;
  const auto learn = [&](EmissionPace& pace) {
    const auto now = Budget::Clock::now();
    pace.finished(std::exchange(expected, 0), now - std::exchange(began, now));
  };
  const auto firstLate = std::ranges::lower_bound(named_, std::exchange(firstLate_, 0), {}, &Named::id);
  const auto first = static_cast<std::size_t>(firstLate - named_.begin());
  for (std::size_t k = 0, all = collected_.size(), looked = 0; k < all && waiting > 0; ++k) {
    const std::size_t i = (first + k) % all;
    fetchHeldAfter(i, isLate);
    if (!collected_[i]) continue;
    // Callbacks may have destroyed some meanwhile.
    if (!isLate && looked++ % kHeldBetweenLooks == 0 && isTooLateFor(std::min(waiting, all - k))) {
      isLate = true;
      firstLate_ = named_[i].id;
      learn(holdingPace_);
    }
    --waiting;
    holdPair(i, isLate);
    expected += (isLate ? latePace_ : holdingPace_).expectedNanoseconds(0);
  }
  if (left_.hasDeadline()) learn(isLate ? latePace_ : holdingPace_);
}

void NarrowPhase::Impl::holdPair(std::size_t index, bool isLate) {
  TreePair& pair = *collected_[index];
  btManifoldResult result(&pair.bodies.body0(), &pair.bodies.body1());
  hold(pair, result, left_, isLate);
  if (!pair.isBegun()) ++tally_.statistics.pairs;
  dismiss(index);
}

// Held back from refinement, it would leave the next steps nothing to refine with. What is less is better measured at
// the end, together with the rest: flat faces find their common direction so.
bool NarrowPhase::Impl::isMostOfAStep(const Promise& promise) const {
  constexpr double kMost = 0.75;
  const StepBudget limit = stepLimit();
  return (limit.operations && double(promise.operations) > kMost * double(*limit.operations)) ||
         (limit.microseconds && promise.nanoseconds > kMost * 1e3 * *limit.microseconds);
}

// What was promised for it is withdrawn, or the next step would hold it back again.
PairReport NarrowPhase::Impl::hold(TreePair& pair, btManifoldResult& result, Budget& budget, bool isLate) {
  const bool isTooMuch = isMostOfAStep(pair.work.promised);
  withdrawPromise(pair, budget);
  if (pair.isBegun() && isTooMuch) pair.contacts.measureFound(*pair.counterpart, budget, scratch_);
  budget.chargeAnyway(StepPlan::kHoldingCost);
  const PairReport report = bullet::hold(pair, {dispatcher_, result, timeStep_, isLate});
  return count(report, seen(pair));
}

// Whether so many pairs can only be held as the late are, if at all.
bool NarrowPhase::Impl::isTooLateFor(std::size_t pairs) const {
  return left_.nanosecondsLeft() < latePace_.expectedNanoseconds(0) * static_cast<double>(pairs);
}

// What is late hardly ever gets to its points.
void NarrowPhase::Impl::fetchHeldAfter(std::size_t index, bool isLate) const {
  const auto after = [&](std::size_t ahead) {
    return index + ahead < collected_.size() ? collected_[index + ahead] : nullptr;
  };
  if (const TreePair* pair = after(kHeldAhead)) fetch(*pair, PairPart::held);
  if (isLate) return;
  if (const TreePair* pair = after(kHeldBodiesAhead)) fetch(*pair, PairPart::heldBodies);
  if (const TreePair* pair = after(kHeldPointsAhead)) fetch(*pair, PairPart::points);
}

void NarrowPhase::Impl::finishBegunPairs() {
  for (std::size_t i = 0; i < collected_.size(); ++i)
    if (collected_[i] && !isBetterHeld(*collected_[i])) finishPair(i);
}

Progress NarrowPhase::Impl::resumePairs() {
  Progress progress = Progress::done;
  for (std::size_t i = 0; i < collected_.size() && progress == Progress::done; ++i)
    if (collected_[i] && collected_[i]->isBegun()) progress = scheduler_.runAlone(scheduled_, i, left_, this);
  return progress;
}

// In an open step Bullet asks for them one by one.
bool NarrowPhase::Impl::finishResolvedPairs() {
  if (stepEnd_ != StepEnd::told) return false;
  bool hasFinished = false;
  for (std::size_t i = 0; i < collected_.size(); ++i) {
    if (!collected_[i] || !collected_[i]->isBegun() || !collected_[i]->isDone()) continue;
    finishPair(i);
    hasFinished = true;
  }
  return hasFinished;
}

// From the whole of what was done for pairs that were not held.
void NarrowPhase::Impl::learnUpdates(std::uint64_t operationsBefore, Budget::Clock::time_point began) {
  if (!left_.hasDeadline() || updated_ == 0) return;
  const double expected = updatePace_.expectedNanoseconds(left_.used() - operationsBefore) +
                          static_cast<double>(updated_ - 1) * updatePace_.expectedNanoseconds(0);
  updatePace_.finished(expected, Budget::Clock::now() - began);
}

}  // namespace cairn::bullet
