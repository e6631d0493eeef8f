// SPDX-License-Identifier: Zlib
#include "dispatch/open_step_answers.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "pairs/pair_begin.h"
#include "pairs/pair_carry_over.h"
#include "pairs/pair_collect.h"
#include "pairs/pair_cull.h"
#include "pairs/pair_finish.h"

namespace cairn::bullet {

namespace {

// Unexpected pairs share the reservation and the rest of others, first come first served: each may take an eighth.
constexpr int kNewcomersShare = 8;

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

bool OpenStepAnswers::answer(TreePair& pair, const btCollisionObjectWrapper& body0,
                             const btCollisionObjectWrapper& body1, btManifoldResult& result) {
  const auto isPreparedNow = [&] { return pair.notes.isCollected() && pair.bodies.are(body0, body1); };
  if (steps_.isOver(pair, isPreparedNow())) beginStep();

  const bool isPrepared = isPreparedNow();
  const bool wasExpected = pair.notes.isCollected();
  if (wasExpected) step_.pairs.dismiss(pair.notes.collectedAt);
  if (wasExpected && !isPrepared) withdraw(pair);
  if (!isPrepared && !collect(pair, body0, body1)) {
    steps_.forget(pair);
    return false;
  }
  if (!isPrepared) cullSeparated(pair, body0, body1, step_.rules.mayBeInterrupted(), step_.horizon());
  if (cull(pair, wasExpected)) return true;
  if (isPrepared || refineNewcomer(pair, body0, body1)) tell(pair, result);
  return true;
}

// Notes that the pair came. True when it needs no more work.
bool OpenStepAnswers::cull(TreePair& pair, bool wasExpected) {
  steps_.answered(pair, wasExpected || pair.isCulled());
  pair.notes.lastReport = {};
  if (!pair.isCulled()) return false;
  ++step_.tally.statistics.pairs;
  if (pair.is(PairStage::nonFinite)) nonFinite_.count();
  step_.tally.statistics.nonFinitePairs += nonFinite_.takeCount();
  return true;
}

// Releases the pair's reservation.
void OpenStepAnswers::withdraw(TreePair& pair) {
  const Reservation own = std::exchange(pair.work.reserved, {});
  heldBack_.operations -= std::min(own.operations, heldBack_.operations);
  heldBack_.nanoseconds -= own.nanoseconds;
}

void OpenStepAnswers::tell(TreePair& pair, btManifoldResult& result) {
  const auto began = Budget::Clock::now();
  Budget budget = StepRules::budgetOf(left_);
  budget.reserve(heldBack_);  // triangles leave the others enough to be answered
  const Reservation own = pair.work.reserved;
  heldBack_.operations -= own.operations;
  heldBack_.nanoseconds -= own.nanoseconds;
  ++step_.tally.statistics.pairs;
  if (isBetterCarriedOver(pair)) {
    carryOver_.carryOver(pair, result, budget, false);
  } else {
    const ScheduledPair before = scheduled(pair);
    const PairReport report = finish(pair, step_.dispatcher, result, step_.rules.answerPolicy(), budget, step_.scratch);
    step_.count(pair, report, before);
  }
  if (step_.rules.asksTriangles())
    bookRefinement(budget, began);
  else
    book(budget, began);
}

void OpenStepAnswers::beginStep() {
  endStep();
  dropUnanswered();
  refinement_.endStep();
  carryOver_.endStep();
  step_.endStep();
  step_.tally = {};
  left_ = step_.rules.limit();
  step_.tally.statistics.deadlineMicroseconds = left_.microseconds;
  nonFinite_.cullLeftOvers(true);  // those that Bullet asks about are counted when it does

  const auto began = Budget::Clock::now();
  steps_.begin(step_.dispatcher, step_.pairs);
  const double reserve = steps_.reserve(cullExpected());
  step_.left = StepRules::budgetOf(fractionOf(left_, 1 - reserve));
  refineExpected(reserve);
  bookRefinement(step_.left, began);
}

// Returns the number of expected pairs that are not culled. Contacts end: users' callbacks may destroy any pair.
std::size_t OpenStepAnswers::cullExpected() {
  std::size_t near = 0;
  for (std::size_t i = 0; i < step_.pairs.size(); ++i) {
    TreePair* const pair = step_.pairs[i];
    if (!pair) continue;
    const bool isCulled = cullSeparated(*pair, pair->bodies.body0(), pair->bodies.body1(),
                                        step_.rules.mayBeInterrupted(), step_.horizon());
    near += isCulled ? 0 : 1;
  }
  return near;
}

void OpenStepAnswers::refineExpected(double reserve) {
  step_.pairs.order();
  refinement_.planStep();
  const auto planned = Budget::Clock::now();
  const std::uint64_t operationsBefore = step_.left.used();
  refinement_.beginPairs();
  refinement_.refinePairs();
  step_.tally.statistics.pairs = 0;  // counted as they come
  refinement_.learnUpdates(operationsBefore, planned);
  carryOver_.withdraw();
  // The reservation is left for the pairs as they come.
  const StepBudget kept = fractionOf(step_.rules.limit(), reserve);
  heldBack_ = {static_cast<std::uint64_t>(kept.operations.value_or(0)), kept.microseconds.value_or(0) * 1e3};
  for (const TreePair* pair : step_.pairs.list())
    if (pair) {
      heldBack_.operations += pair->work.reserved.operations;
      heldBack_.nanoseconds += pair->work.reserved.nanoseconds;
    }
}

void OpenStepAnswers::endStep() {
  if (steps_.hasEnded()) return;
  steps_.end();
  step_.rules.spend(step_.tally.statistics.operations, step_.tally.statistics.microseconds);
}

const StepStatistics& OpenStepAnswers::lastStep() {
  reported_ = withOutstanding();
  return reported_.statistics;
}

// Bullet's order may begin with a pair that seemed to be the last of the step before. It was answered there, and comes
// again when this step is over. Until then its last report stands.
StepTally OpenStepAnswers::withOutstanding() const {
  StepTally tally = step_.tally;
  for (std::size_t i = 0; i < step_.pairs.size(); ++i) {
    const TreePair* const pair = step_.pairs[i];
    if (!pair) continue;
    ++tally.statistics.pairs;
    if (pair->is(PairStage::nonFinite)) ++tally.statistics.nonFinitePairs;
    if (!pair->isCulled()) tally.add(pair->notes.lastReport);
  }
  return tally;
}

void OpenStepAnswers::dropUnanswered() {
  for (std::size_t i = 0; i < step_.pairs.size(); ++i)
    if (TreePair* const pair = step_.pairs[i]) {
      step_.pairs.dismiss(i);
      steps_.forget(*pair);
    }
  step_.pairs.clear();
}

// Also for an expected pair whose bodies have moved since the step began. False when its shapes have no contacts.
bool OpenStepAnswers::refineNewcomer(TreePair& pair, const btCollisionObjectWrapper& body0,
                                     const btCollisionObjectWrapper& body1) {
  const auto began = Budget::Clock::now();
  StepBudget share = fractionOf(left_, 1.0 / kNewcomersShare);
  if (share.operations)
    share.operations =
        std::min(*left_.operations, std::max<std::int64_t>(*share.operations, Scheduler::kTurnOperations));
  Budget budget = StepRules::budgetOf(share);
  const RefreshPolicy refresh = step_.rules.mayBeInterrupted() ? RefreshPolicy::allIfFew : RefreshPolicy::all;
  const bool hasBegun = begin(pair, body0, body1, step_.horizon(), 0, refresh, budget, step_.scratch);
  if (hasBegun) pair.traversal().refine(budget);
  bookRefinement(budget, began);
  return hasBegun;
}

void OpenStepAnswers::bookRefinement(const Budget& used, Budget::Clock::time_point began) {
  if (left_.operations)
    left_.operations = std::max<std::int64_t>(*left_.operations - static_cast<std::int64_t>(used.used()), 0);
  if (left_.microseconds) left_.microseconds = std::max(*left_.microseconds - microsecondsSince(began), 0.0);
  book(used, began);
}

void OpenStepAnswers::book(const Budget& used, Budget::Clock::time_point began) {
  step_.tally.statistics.operations += used.used();
  step_.tally.statistics.microseconds += microsecondsSince(began);
  step_.tally.tookUntilNow(step_.tally.statistics.microseconds);
}

}  // namespace cairn::bullet
