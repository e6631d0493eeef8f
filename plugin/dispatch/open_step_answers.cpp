// SPDX-License-Identifier: Zlib
// The narrow phase on a dispatcher that does not say where steps end: pairs are refined together when the first of a
// step comes, and answered one by one as they come.
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

namespace {

// New pairs share what is kept for them, or left by others, first come first served: each may take an eighth.
constexpr int kNewcomersShare = 8;

bool isGhost(const btCollisionObject& object) {
  return (object.getInternalType() & btCollisionObject::CO_GHOST_OBJECT) != 0;
}

double microsecondsSince(Budget::Clock::time_point began) {
  return std::chrono::duration<double, std::micro>(Budget::Clock::now() - began).count();
}

StepBudget fractionOf(const StepBudget& budget, double fraction) {
  StepBudget part = budget;
  if (part.operations) part.operations = static_cast<std::int64_t>(static_cast<double>(*part.operations) * fraction);
  if (part.microseconds) *part.microseconds *= fraction;
  return part;
}

}  // namespace

// False, and nothing done, for what is answered at once: pairs of ghosts, and those nested too deep to be remembered.
bool NarrowPhase::Impl::answerInOpenStep(TreePair& pair, const btCollisionObjectWrapper& body0,
                                         const btCollisionObjectWrapper& body1, const btDispatcherInfo& info,
                                         btManifoldResult& result) {
  if (isGhost(*body0.getCollisionObject()) || isGhost(*body1.getCollisionObject())) return false;
  takeTime(info);
  isAnswering_ = true;
  const bool isAnswered = answerOpenly(pair, body0, body1, result);
  endAnswering();
  return isAnswered;
}

bool NarrowPhase::Impl::answerOpenly(TreePair& pair, const btCollisionObjectWrapper& body0,
                                     const btCollisionObjectWrapper& body1, btManifoldResult& result) {
  const auto isPreparedNow = [&] { return pair.notes.isCollected() && pair.bodies.are(body0, body1); };
  if (open_.isOver(pair, isPreparedNow())) beginOpenStep();

  const bool isPrepared = isPreparedNow();
  const bool wasExpected = pair.notes.isCollected();
  if (wasExpected) dismiss(pair.notes.collectedAt);
  if (!isPrepared && !bullet::collect(pair, body0, body1)) {
    open_.forget(pair);
    return false;
  }
  if (!isPrepared) settleApart(pair, body0, body1, mayBeInterrupted(), outlook());
  open_.answered(pair, wasExpected || pair.isSettled());
  pair.notes.lastReport = {};
  if (pair.isSettled()) {
    ++tally_.statistics.pairs;
    if (pair.is(PairStage::broken)) countBroken();
    tally_.statistics.brokenPairs += brokenPairs_.exchange(0);
    return true;
  }
  if (!isPrepared && !refineNewcomer(pair, body0, body1)) return true;

  const auto began = Budget::Clock::now();
  Budget budget = budgetOf(openLeft_);
  budget.promise(openHeld_);  // triangles leave the others what they need to be answered
  const Promise own = pair.work.promised;
  openHeld_.operations -= own.operations;
  openHeld_.nanoseconds -= own.nanoseconds;
  ++tally_.statistics.pairs;
  if (!isBetterHeld(pair)) {
    const ScheduledPair seen = bullet::scheduled(pair);
    pair.notes.lastReport = count(bullet::finish(pair, dispatcher_, result, answerPolicy(), budget, scratch_), seen);
  } else {
    pair.notes.lastReport = hold(pair, result, budget, false);
  }
  if (finest_ == Finest::triangles)
    bookRefinement(budget, began);
  else
    book(budget, began);
  return true;
}

void NarrowPhase::Impl::beginOpenStep() {
  endOpenStep();
  dropUnansweredPairs();
  learnFromStep();
  tally_ = {};
  openLeft_ = stepLimit();
  settleLeftOvers(true);  // those Bullet asks about are counted when it does

  const auto began = Budget::Clock::now();
  open_.begin(dispatcher_, collected_);
  const bool alsoFromGround = mayBeInterrupted();
  const auto near = std::ranges::count_if(collected_, [&](TreePair* pair) {
    return !settleApart(*pair, pair->bodies.body0(), pair->bodies.body1(), alsoFromGround, outlook());
  });
  const double reserve = open_.reserve(static_cast<std::size_t>(near));
  left_ = budgetOf(fractionOf(openLeft_, 1 - reserve));
  scheduled_.clear();
  orderPairs();
  planStep();
  const auto planned = Budget::Clock::now();
  const std::uint64_t operationsBefore = left_.used();
  beginPairs();
  refinePairs();
  tally_.statistics.pairs = 0;  // they are counted as they come
  learnUpdates(operationsBefore, planned);
  left_.redeem(std::exchange(holding_, {}));
  bookRefinement(left_, began);
  // What was held back is left for the pairs as they come.
  const StepBudget kept = fractionOf(stepLimit(), reserve);
  openHeld_ = {static_cast<std::uint64_t>(kept.operations.value_or(0)), kept.microseconds.value_or(0) * 1e3};
  for (const TreePair* pair : collected_)
    if (pair) {
      openHeld_.operations += pair->work.promised.operations;
      openHeld_.nanoseconds += pair->work.promised.nanoseconds;
    }
}

void NarrowPhase::Impl::endOpenStep() {
  if (open_.hasEnded()) return;
  open_.end();
  frame_.spend(tally_.statistics.operations, tally_.statistics.microseconds);
}

const StepStatistics& NarrowPhase::Impl::lastStep() {
  if (stepEnd_ == StepEnd::told) return tally_.statistics;
  told_ = withOutstanding();
  return told_.statistics;
}

// Bullet's order may begin with a pair that looked like the last of the step before: it was answered there, and comes
// again when this one is over. Until then what it said stands.
StepTally NarrowPhase::Impl::withOutstanding() const {
  StepTally tally = tally_;
  for (const TreePair* const pair : collected_) {
    if (!pair) continue;
    ++tally.statistics.pairs;
    if (pair->is(PairStage::broken)) ++tally.statistics.brokenPairs;
    if (!pair->isSettled()) tally.add(pair->notes.lastReport);
  }
  return tally;
}

void NarrowPhase::Impl::dropUnansweredPairs() {
  for (std::size_t i = 0; i < collected_.size(); ++i)
    if (TreePair* const pair = collected_[i]) {
      dismiss(i);
      open_.forget(*pair);
    }
  collected_.clear();
}

// Also for an expected pair whose bodies are not where they were when the step began. False when its shapes have no
// contacts.
bool NarrowPhase::Impl::refineNewcomer(TreePair& pair, const btCollisionObjectWrapper& body0,
                                       const btCollisionObjectWrapper& body1) {
  const auto began = Budget::Clock::now();
  StepBudget share = fractionOf(openLeft_, 1.0 / kNewcomersShare);
  if (share.operations)
    share.operations =
        std::min(*openLeft_.operations, std::max<std::int64_t>(*share.operations, Scheduler::kTurnOperations));
  Budget budget = budgetOf(share);
  const Remeasured remeasured = mayBeInterrupted() ? Remeasured::allIfFew : Remeasured::all;
  const bool hasBegun = bullet::begin(pair, body0, body1, outlook(), 0, remeasured, budget, scratch_);
  if (hasBegun) pair.traversal().refine(budget);
  bookRefinement(budget, began);
  return hasBegun;
}

void NarrowPhase::Impl::bookRefinement(const Budget& used, Budget::Clock::time_point began) {
  if (openLeft_.operations)
    openLeft_.operations = std::max<std::int64_t>(*openLeft_.operations - static_cast<std::int64_t>(used.used()), 0);
  if (openLeft_.microseconds)
    openLeft_.microseconds = std::max(*openLeft_.microseconds - microsecondsSince(began), 0.0);
  book(used, began);
}

void NarrowPhase::Impl::book(const Budget& used, Budget::Clock::time_point began) {
  tally_.statistics.operations += used.used();
  tally_.statistics.microseconds += microsecondsSince(began);
}

}  // namespace cairn::bullet
