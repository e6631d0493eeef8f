// SPDX-License-Identifier: Zlib
#include "dispatch/narrow_phase_impl.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "cairn/bullet/manifold_order.h"
#include "dispatch/left_behind.h"
#include "dispatch/step_tuning.h"
#include "pairs/pair_begin.h"

namespace cairn::bullet {

NarrowPhase::Impl::Impl(btCollisionDispatcher& dispatcher, StepEnd stepEnd, DispatchThreads threads)
    : step_(dispatcher, stepEnd), hasThreads_(threads == DispatchThreads::several) {
  takeAwayLeftBehind(dispatcher);
  registration_.emplace(dispatcher, *this);
}

void NarrowPhase::Impl::hook(btCollisionWorld& world) {
  takeAwayLeftBehind(world);
  hook_.emplace(world, step_.dispatcher, *this);
}

void NarrowPhase::Impl::retire() {
  assert(!isCollecting_ && !isAnswering_ && "a narrow phase must not die while its dispatcher is dispatching");
  isRetired_ = true;
  if (hostsMayBeGone()) {
    if (hook_) hook_->leave();
    registration_->leave();
    return leaveBehind(shared_from_this());
  }
  hook_.reset();
  registration_.reset();
}

// A `Dispatcher` is there while its narrow phase is; a world with objects would have taken them out as it died, and
// pairs are gone before their dispatcher is.
bool NarrowPhase::Impl::hostsMayBeGone() {
  if (hook_) return !hook_->hasObjects();
  if (step_.rules.end() == StepEnd::reported) return false;
  const std::lock_guard lock(mutex_);
  return !pool_.hasTaken();
}

bool NarrowPhase::Impl::undoOn(const btCollisionDispatcher& dispatcher) {
  if (&step_.dispatcher == &dispatcher) registration_.reset();
  return !hook_ && !registration_;
}

bool NarrowPhase::Impl::undoOn(const btCollisionWorld& world) {
  if (hook_ && hook_->isOn(world)) hook_.reset();
  return !hook_ && !registration_;
}

Status NarrowPhase::Impl::setBudget(const StepBudget& budget) {
  const Status status = step_.rules.setBudget(budget);
  if (status) reserveFor(budget);
  return status;
}

Status NarrowPhase::Impl::setFrameBudget(const StepBudget& budget) {
  const Status status = step_.rules.setFrameBudget(budget);
  if (status) reserveFor(budget);
  return status;
}

void NarrowPhase::Impl::beginFrame(int steps) {
  if (step_.rules.end() == StepEnd::open) open_.endStep();
  step_.rules.beginFrame(steps);
}

void NarrowPhase::Impl::setPriority(std::unique_ptr<Priority> priority) {
  step_.rules.setPriority(std::move(priority));
  if (!isAnswering_) step_.rules.adoptPriority();
}

const StepStatistics& NarrowPhase::Impl::lastStep() {
  return step_.rules.end() == StepEnd::reported ? step_.tally.statistics : open_.lastStep();
}

// A user's callback may set a budget, even in every step.
void NarrowPhase::Impl::reserveFor(const StepBudget& budget) {
  if (budget.microseconds && !std::exchange(hasRoomForDeadlines_, true)) reserve(countsByKind(kReserved));
}

void NarrowPhase::Impl::reserve(const PairCounts& pairs) {
  if (isCollecting_ || isAnswering_) {
    if (!nextRoom_) nextRoom_.emplace();
    for (std::size_t kind = 0; kind < pairs.size(); ++kind)
      (*nextRoom_)[kind] = std::max((*nextRoom_)[kind], pairs[kind]);
    return;
  }
  const std::lock_guard lock(mutex_);
  const std::size_t all = pool_.reserve(pairs);
  step_.pairs.reserve(all);
  step_.plan.reserve(all);
  asked_.reserve(all);
}

// Requests that callbacks made meanwhile.
void NarrowPhase::Impl::endAnswering() {
  isAnswering_ = false;
  step_.rules.adoptPriority();
  if (const auto room = std::exchange(nextRoom_, std::nullopt)) reserve(*room);
}

std::vector<ServedPair> NarrowPhase::Impl::servedPairs() {
  const std::lock_guard lock(mutex_);
  return pool_.servedPairs();
}

std::vector<PairAnswered> NarrowPhase::Impl::lastAnswers() {
  const std::lock_guard lock(mutex_);
  return pool_.lastAnswers();
}

TreePair* NarrowPhase::Impl::acquire(ColliderKind kind) {
  const std::lock_guard lock(mutex_);
  return pool_.take(kind);
}

void NarrowPhase::Impl::release(TreePair* pair) {
  const std::lock_guard lock(mutex_);
  if (pair->notes.isCollected()) {
    cancelReservation(*pair, step_.left);
    step_.pairs.dismiss(pair->notes.collectedAt);
  }
  open_.forget(*pair);
  nonFinite_.forget(*pair);
  pool_.giveBack(*pair);
}

void NarrowPhase::Impl::endStep() {
  if (!isCollecting_) return;
  isCollecting_ = false;
  isAnswering_ = true;
  StepStatistics& statistics = (step_.tally = {}).statistics;
  statistics.deadlineMicroseconds = clock_.deadline();
  statistics.pairs = culledPairs_.exchange(0);
  statistics.nonFinitePairs = nonFinite_.takeCount();
  statistics.nonFinitePairs += nonFinite_.cullLeftOvers(false);
  answerCollected();
  if (hasThreads_) orderManifolds(step_.dispatcher);
  endAnswering();
  refinement_.endStep();
  carryOver_.endStep();
  step_.endStep();
  {
    const std::lock_guard lock(mutex_);
    pool_.endStep();
  }

  statistics.operations = step_.left.used();
  const double elapsed = clock_.end();
  step_.tally.tookUntilNow(elapsed);
  step_.rules.spend(step_.left.used(), elapsed);
  statistics.microseconds = clock_.spentOnCpu();
}

void NarrowPhase::Impl::answerCollected() {
  step_.pairs.order();
  if (!step_.rules.mayBeInterrupted()) return answers_.answerAll();
  refinement_.planStep();
  const auto began = Budget::Clock::now();
  const std::uint64_t operationsBefore = step_.left.used();
  refinement_.beginPairs();
  // Some turns are given however short the time is: pairs without an answer would otherwise block each other for ever.
  if (step_.rules.limit().microseconds.value_or(0) > 0) step_.left.guarantee(step_tuning::kMinOperations);
  refinement_.refinePairs();
  refinement_.finishBegunPairs();
  refinement_.learnUpdates(operationsBefore, began);
  carryOver_.carryOverPairs();
}

}  // namespace cairn::bullet
