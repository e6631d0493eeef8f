// SPDX-License-Identifier: Zlib
#include "dispatch/step_carry_over.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>
#include <utility>

#include "pairs/pair_begin.h"
#include "pairs/pair_carry_over.h"
#include "pairs/pair_prefetch.h"

namespace cairn::bullet {

void StepCarryOver::reserve() {
  step_.left.release(reserved_);
  const std::size_t count = step_.plan.carriedOver().size();
  reserved_.operations = std::min<std::uint64_t>(count * StepPlan::kCarryOverOperations, step_.left.remaining() / 2);
  reserved_.nanoseconds = static_cast<double>(count) * cost_.expectedNanoseconds(0);
  step_.left.reserve(reserved_);
}

void StepCarryOver::withdraw() {
  step_.left.release(std::exchange(reserved_, {}));
}

void StepCarryOver::endStep() {
  cost_.endStep();
  lateCost_.endStep();
  cost_.raiseTo(lateCost_);
}

void StepCarryOver::carryOverPairs() {
  withdraw();
  const StepPairs& pairs = step_.pairs;
  std::size_t waiting = pairs.waiting();
  auto began = Budget::Clock::now();
  double expected = 0;
  std::size_t carriedOver = 0;
  bool isLate = false;
  const auto learn = [&](CostModel& cost) {
    const auto now = Budget::Clock::now();
    cost.finished(std::exchange(expected, 0), now - std::exchange(began, now), std::exchange(carriedOver, 0));
  };
  const std::size_t first = pairs.firstFrom(std::exchange(firstLate_, 0));
  for (std::size_t k = 0, all = pairs.size(), looked = 0; k < all && waiting > 0; ++k) {
    const std::size_t i = (first + k) % all;
    prefetchAfter(i, isLate);
    if (!pairs[i]) continue;
    // Callbacks may have destroyed some pairs meanwhile.
    if (!isLate && looked++ % step_tuning::kCarriedBetweenClockLooks == 0 && isTooLateFor(std::min(waiting, all - k))) {
      isLate = true;
      firstLate_ = pairs.nameOf(i);
      learn(cost_);
    }
    --waiting;
    carryOverPair(i, isLate);
    ++carriedOver;
    expected += (isLate ? lateCost_ : cost_).expectedNanoseconds(0);
  }
  if (step_.left.hasDeadline()) learn(isLate ? lateCost_ : cost_);
}

void StepCarryOver::carryOverPair(std::size_t index, bool isLate) {
  TreePair& pair = *step_.pairs[index];
  btManifoldResult result(&pair.bodies.body0(), &pair.bodies.body1());
  carryOver(pair, result, step_.left, isLate);
  if (!pair.isBegun()) ++step_.tally.statistics.pairs;
  step_.pairs.dismiss(index);
}

// A smaller cost is better left to the end, where all leaf pairs are measured together: flat faces find their common
// normal so.
bool StepCarryOver::isLargeShareOfStep(const Reservation& reserve) const {
  using step_tuning::kLargeShareOfStep;
  const StepBudget limit = step_.rules.limit();
  return (limit.operations && double(reserve.operations) > kLargeShareOfStep * double(*limit.operations)) ||
         (limit.microseconds && reserve.nanoseconds > kLargeShareOfStep * 1e3 * *limit.microseconds);
}

// Cancels its reservation; otherwise the next step would reserve for it again.
void StepCarryOver::carryOver(TreePair& pair, btManifoldResult& result, Budget& budget, bool isLate) {
  const bool isTooMuch = isLargeShareOfStep(pair.work.reserved);
  cancelReservation(pair, budget);
  if (pair.isBegun() && isTooMuch) pair.contacts.measureFound(*pair.collider, budget, step_.scratch);
  budget.forceCharge(StepPlan::kCarryOverOperations);
  const PairReport report = bullet::carryOver(pair, {step_.dispatcher, result, step_.timeStep, isLate});
  step_.count(pair, report, seen(pair));
}

// Whether there is only time to carry this many pairs over as late ones, if at all.
bool StepCarryOver::isTooLateFor(std::size_t pairs) const {
  return step_.left.nanosecondsLeft() < lateCost_.expectedNanoseconds(0) * static_cast<double>(pairs);
}

// Late pairs hardly ever read their points.
void StepCarryOver::prefetchAfter(std::size_t index, bool isLate) const {
  if (const TreePair* pair = step_.pairs.after(index, step_tuning::kCarriedAhead))
    prefetch(*pair, PairPart::carriedOver);
  if (isLate) return;
  if (const TreePair* pair = step_.pairs.after(index, step_tuning::kCarriedBodiesAhead))
    prefetch(*pair, PairPart::carriedBodies);
  if (const TreePair* pair = step_.pairs.after(index, step_tuning::kCarriedPointsAhead))
    prefetch(*pair, PairPart::points);
}

}  // namespace cairn::bullet
