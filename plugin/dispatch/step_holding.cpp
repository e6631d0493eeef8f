// SPDX-License-Identifier: Zlib
#include "dispatch/step_holding.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>
#include <utility>

#include "pairs/pair_begin.h"
#include "pairs/pair_fetch.h"
#include "pairs/pair_hold.h"

namespace cairn::bullet {

void StepHolding::promise() {
  step_.left.redeem(promised_);
  const std::size_t count = step_.plan.held().size();
  promised_.operations = std::min<std::uint64_t>(count * StepPlan::kHoldingCost, step_.left.remaining() / 2);
  promised_.nanoseconds = static_cast<double>(count) * pace_.expectedNanoseconds(0);
  step_.left.promise(promised_);
}

void StepHolding::withdraw() {
  step_.left.redeem(std::exchange(promised_, {}));
}

void StepHolding::endStep() {
  pace_.endStep();
  latePace_.endStep();
  pace_.raiseTo(latePace_);
}

void StepHolding::holdPairs() {
  withdraw();
  const StepPairs& pairs = step_.pairs;
  std::size_t waiting = pairs.waiting();
  auto began = Budget::Clock::now();
  double expected = 0;
  std::size_t held = 0;
  bool isLate = false;
  const auto learn = [&](EmissionPace& pace) {
    const auto now = Budget::Clock::now();
    pace.finished(std::exchange(expected, 0), now - std::exchange(began, now), std::exchange(held, 0));
  };
  const std::size_t first = pairs.firstFrom(std::exchange(firstLate_, 0));
  for (std::size_t k = 0, all = pairs.size(), looked = 0; k < all && waiting > 0; ++k) {
    const std::size_t i = (first + k) % all;
    fetchAfter(i, isLate);
    if (!pairs[i]) continue;
    // Callbacks may have destroyed some meanwhile.
    if (!isLate && looked++ % step_tuning::kHeldBetweenLooks == 0 && isTooLateFor(std::min(waiting, all - k))) {
      isLate = true;
      firstLate_ = pairs.nameOf(i);
      learn(pace_);
    }
    --waiting;
    holdPair(i, isLate);
    ++held;
    expected += (isLate ? latePace_ : pace_).expectedNanoseconds(0);
  }
  if (step_.left.hasDeadline()) learn(isLate ? latePace_ : pace_);
}

void StepHolding::holdPair(std::size_t index, bool isLate) {
  TreePair& pair = *step_.pairs[index];
  btManifoldResult result(&pair.bodies.body0(), &pair.bodies.body1());
  hold(pair, result, step_.left, isLate);
  if (!pair.isBegun()) ++step_.tally.statistics.pairs;
  step_.pairs.dismiss(index);
}

// What is less is better measured at the end, together with the rest: flat faces find their common direction so.
bool StepHolding::isMostOfAStep(const Promise& promise) const {
  using step_tuning::kMostOfAStep;
  const StepBudget limit = step_.rules.limit();
  return (limit.operations && double(promise.operations) > kMostOfAStep * double(*limit.operations)) ||
         (limit.microseconds && promise.nanoseconds > kMostOfAStep * 1e3 * *limit.microseconds);
}

// What was promised for it is withdrawn, or the next step would hold it back again.
PairReport StepHolding::hold(TreePair& pair, btManifoldResult& result, Budget& budget, bool isLate) {
  const bool isTooMuch = isMostOfAStep(pair.work.promised);
  withdrawPromise(pair, budget);
  if (pair.isBegun() && isTooMuch) pair.contacts.measureFound(*pair.counterpart, budget, step_.scratch);
  budget.chargeAnyway(StepPlan::kHoldingCost);
  const PairReport report = bullet::hold(pair, {step_.dispatcher, result, step_.timeStep, isLate});
  return step_.count(report, seen(pair));
}

// Whether so many pairs can only be held as the late are, if at all.
bool StepHolding::isTooLateFor(std::size_t pairs) const {
  return step_.left.nanosecondsLeft() < latePace_.expectedNanoseconds(0) * static_cast<double>(pairs);
}

// What is late hardly ever gets to its points.
void StepHolding::fetchAfter(std::size_t index, bool isLate) const {
  if (const TreePair* pair = step_.pairs.after(index, step_tuning::kHeldAhead)) fetch(*pair, PairPart::held);
  if (isLate) return;
  if (const TreePair* pair = step_.pairs.after(index, step_tuning::kHeldBodiesAhead))
    fetch(*pair, PairPart::heldBodies);
  if (const TreePair* pair = step_.pairs.after(index, step_tuning::kHeldPointsAhead)) fetch(*pair, PairPart::points);
}

}  // namespace cairn::bullet
