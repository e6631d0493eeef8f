// SPDX-License-Identifier: Zlib
#include "dispatch/narrow_phase_impl.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "cairn/bullet/manifold_order.h"
#include "cairn/core/round_robin.h"
#include "memory/written_room.h"

namespace cairn::bullet {

namespace {

Status check(const StepBudget& budget, const std::string& what) {
  if (budget.operations && *budget.operations < 0)
    return Error{what + " cannot have " + std::to_string(*budget.operations) +
                 " operations: give 0 or more, or leave them unset for no limit"};
  if (budget.microseconds && !(*budget.microseconds >= 0))
    return Error{what + " cannot have " + std::to_string(*budget.microseconds) +
                 " microseconds: give 0 or more, or leave them unset for no limit"};
  return {};
}

}  // namespace

NarrowPhase::Impl::Impl(btCollisionDispatcher& dispatcher, StepEnd stepEnd)
    : dispatcher_(dispatcher),
      stepEnd_(stepEnd),
      hasThreads_(dynamic_cast<btCollisionDispatcherMt*>(&dispatcher) != nullptr),
      priority_(std::make_unique<RoundRobin>()) {
  registration_.emplace(dispatcher, *this);
}

void NarrowPhase::Impl::hook(btCollisionWorld& world) {
  hook_.emplace(world, dispatcher_, *this);
}

void NarrowPhase::Impl::retire() {
  assert(!isCollecting_ && !isAnswering_ && "a narrow phase must not die while its dispatcher is dispatching");
  hook_.reset();
  registration_.reset();
  isRetired_ = true;
}

Status NarrowPhase::Impl::setBudget(const StepBudget& budget) {
  const Status status = check(budget, "a step");
  if (!status) return status;
  budget_ = budget;
  if (budget.microseconds) reserveForDeadlines();
  return {};
}

Status NarrowPhase::Impl::setFrameBudget(const StepBudget& budget) {
  const Status status = check(budget, "a frame");
  if (!status) return status;
  frame_ = FrameBudget(budget);
  hasFrameBudget_ = budget.operations || budget.microseconds;
  if (budget.microseconds) reserveForDeadlines();
  return {};
}

void NarrowPhase::Impl::beginFrame(int steps) {
  if (stepEnd_ == StepEnd::open) endOpenStep();
  frame_.begin(steps);
}

void NarrowPhase::Impl::setPriority(std::unique_ptr<Priority> priority) {
  assert(priority);
  nextPriority_ = std::move(priority);
  if (!isAnswering_) adoptPriority();
}

// Not while one is at work: a user's callback may ask for another.
void NarrowPhase::Impl::adoptPriority() {
  if (!nextPriority_) return;
  priority_ = std::move(nextPriority_);
  priority_->setViewer(viewer_);
}

Status NarrowPhase::Impl::setViewer(const std::optional<Viewer>& viewer) {
  if (viewer)
    if (Status status = checkViewer(*viewer); !status) return status;
  viewer_ = viewer;
  priority_->setViewer(viewer_);
  return {};
}

// A user's callback may set a budget, and may do so in every step.
void NarrowPhase::Impl::reserveForDeadlines() {
  if (!std::exchange(hasRoomForDeadlines_, true)) reserve(kReserved);
}

void NarrowPhase::Impl::reserve(const PairCounts& pairs) {
  if (isCollecting_ || isAnswering_) {
    if (!nextRoom_) nextRoom_.emplace();
    for (std::size_t kind = 0; kind < pairs.size(); ++kind)
      (*nextRoom_)[kind] = std::max((*nextRoom_)[kind], pairs[kind]);
    return;
  }
  const std::lock_guard lock(mutex_);
  for (std::size_t kind = 0; kind < pairs.size(); ++kind) {
    idle_[kind].reserve(pairs[kind]);
    while (idle_[kind].size() < pairs[kind])
      idle_[kind].push_back(all_.emplace_back(std::make_unique<TreePair>(static_cast<CounterpartKind>(kind))).get());
    for (TreePair* const pair : idle_[kind]) pair->contacts.expectInterruptions();
  }
  const std::size_t all = all_.size();
  makeWrittenRoom(collected_, all);
  makeWrittenRoom(asked_, all);
  makeWrittenRoom(newPairs_, all);
  makeWrittenRoom(named_, all);
  makeWrittenRoom(scheduled_, all);
  plan_.reserve(all);
}

// What callbacks asked for meanwhile.
void NarrowPhase::Impl::endAnswering() {
  isAnswering_ = false;
  adoptPriority();
  if (const auto room = std::exchange(nextRoom_, std::nullopt)) reserve(*room);
}

TreePair* NarrowPhase::Impl::acquire(CounterpartKind kind) {
  const std::lock_guard lock(mutex_);
  std::vector<TreePair*>& idle = idle_[static_cast<std::size_t>(kind)];
  if (idle.empty()) return all_.emplace_back(std::make_unique<TreePair>(kind)).get();
  TreePair* const pair = idle.back();
  idle.pop_back();
  // Pairs are often made many at a time.
  constexpr std::size_t kAhead = 2;
  if (idle.size() >= kAhead) fetch(*idle[idle.size() - kAhead], PairPart::state);
  return pair;
}

void NarrowPhase::Impl::release(TreePair* pair) {
  const std::lock_guard lock(mutex_);
  if (pair->notes.isCollected()) {
    withdrawPromise(*pair, left_);
    dismiss(pair->notes.collectedAt);
  }
  open_.forget(*pair);
  if (pair->notes.isOfCompound) {
    std::erase(ofCompounds_, pair);
    std::ranges::replace(leftOvers_, pair, nullptr);
  }
  pair->reset();
  idle_[static_cast<std::size_t>(pair->kind)].push_back(pair);
}

Budget NarrowPhase::Impl::budgetOf(const StepBudget& limit) {
  const std::uint64_t operations =
      limit.operations ? static_cast<std::uint64_t>(*limit.operations) : Budget::kUnlimited;
  return limit.microseconds ? Budget::both(operations, *limit.microseconds) : Budget::operations(operations);
}

bool NarrowPhase::Impl::mayBeInterrupted() const {
  return budget_.operations || budget_.microseconds || hasFrameBudget_;
}

// While it is in the cache; in an open step, when it comes. But what goes on to triangles first leaves the others what
// they need to find their leaves.
bool NarrowPhase::Impl::finishesResolvedAtOnce() const {
  return stepEnd_ == StepEnd::told && !(finest_ == Finest::triangles && mayBeInterrupted());
}

void NarrowPhase::Impl::endStep() {
  if (!isCollecting_) return;
  isCollecting_ = false;
  isAnswering_ = true;
  tally_ = {};
  tally_.statistics.pairs = apartPairs_.exchange(0);
  tally_.statistics.brokenPairs = brokenPairs_.exchange(0) + settleLeftOvers(false);

  orderPairs();
  planStep();
  const auto began = Budget::Clock::now();
  const std::uint64_t operationsBefore = left_.used();
  beginPairs();
  // However short the time, some turns are given: pairs without an answer would hold each other off for ever.
  if (stepLimit().microseconds.value_or(0) > 0) left_.guarantee(kLeastOperations);
  refinePairs();
  finishBegunPairs();
  learnUpdates(operationsBefore, began);
  holdPairs();
  if (hasThreads_) orderManifolds(dispatcher_);
  endAnswering();
  learnFromStep();

  tally_.statistics.operations = left_.used();
  const std::chrono::duration<double, std::micro> elapsed = Budget::Clock::now() - began_;
  if (planned_) overrun_.learn(elapsed.count(), *planned_);
  frame_.spend(left_.used(), elapsed.count());
  const std::chrono::duration<double, std::micro> spent = ThreadCpuClock::now() - stepBegan_;
  tally_.statistics.microseconds = spent.count();
}

void NarrowPhase::Impl::learnFromStep() {
  pace_.endStep();
  updatePace_.endStep();
  holdingPace_.endStep();
  latePace_.endStep();
  holdingPace_.raiseTo(latePace_);
  isScarce_ = tally_.statistics.unresolvedPairs > 0;
  ++step_;
}

// Drops what was destroyed meanwhile, names what is new and orders everything by name.
void NarrowPhase::Impl::orderPairs() {
  std::erase(collected_, nullptr);
  nameNewPairs();
  named_.clear();
  for (TreePair* pair : collected_) named_.push_back({pair->notes.id, pair});
  std::sort(named_.begin(), named_.end(), [](const Named& x, const Named& y) { return x.id < y.id; });
  for (std::size_t i = 0; i < named_.size(); ++i) {
    collected_[i] = named_[i].pair;
    collected_[i]->notes.collectedAt = i;
    scheduled_.push_back({.id = named_[i].id, .traversal = &nothing_});
  }
}

// From here on a user's callbacks may destroy any pair that is not finished.
void NarrowPhase::Impl::beginPairs() {
  updated_ = 0;
  bookedUntil_ = left_.used();
  if (plan_.isScarce()) {
    for (const std::size_t i : plan_.chosen())
      if (collected_[i]) beginPair(i);
    return;
  }
  for (std::size_t i = 0; i < collected_.size(); ++i) {
    fetchPairsAfter(i);
    if (collected_[i]) beginPair(i);
  }
}

void NarrowPhase::Impl::fetchPairsAfter(std::size_t index) const {
  const auto after = [&](std::size_t ahead) {
    return index + ahead < collected_.size() ? collected_[index + ahead] : nullptr;
  };
  if (const TreePair* pair = after(kStatesAhead)) fetch(*pair, PairPart::state);
  if (const TreePair* pair = after(kListsAhead)) fetch(*pair, PairPart::lists);
  if (const TreePair* pair = after(kLeafPairsAhead)) fetch(*pair, PairPart::leafPairs);
}

void NarrowPhase::Impl::beginPair(std::size_t index) {
  TreePair& pair = *collected_[index];
  if (pair.isSettled()) return;
  if (carriesOver(index)) return;
  if (!bullet::begin(pair, pair.bodies.body0(), pair.bodies.body1(), outlook(), 0, remeasuredOf(pair), left_, scratch_))
    return dismiss(index);
  ++tally_.statistics.pairs;
  ++updated_;
  // Without a limit nobody has to wait for a turn.
  if (!mayBeInterrupted()) pair.traversal().refine(left_);
  promise(pair, left_, pace_);
  if (pair.isDone() && finishesResolvedAtOnce()) return finishPair(index);
  bookTo(pair, left_);
  scheduled_[index] = bullet::scheduled(pair);
}

// In an open step Bullet asks for a pair's points later, and about where the bodies are then.
bool NarrowPhase::Impl::carriesPairsOver() const {
  return stepEnd_ == StepEnd::told && finest_ == Finest::triangles;
}

bool NarrowPhase::Impl::carriesOver(std::size_t index) {
  if (!carriesPairsOver()) return false;
  TreePair& pair = *collected_[index];
  const std::optional<PairReport> carried = carryOver(pair);
  if (!carried) return false;
  ++tally_.statistics.pairs;
  count(*carried, seen(pair));
  dismiss(index);
  return true;
}

// While budgets leave pairs unresolved, those that have an answer take turns in looking for what else came near.
Remeasured NarrowPhase::Impl::remeasuredOf(const TreePair& pair) const {
  if (plan_.isScarce()) return Remeasured::allIfFew;
  const bool isThrifty = isScarce_ && mayBeInterrupted() && (pair.notes.id + step_) % kStepsOfThrift != 0;
  return isThrifty ? Remeasured::touching : Remeasured::all;
}

void NarrowPhase::Impl::bookTo(TreePair& pair, const Budget& budget) {
  // In an open step a pair that is done is finished later, from another budget.
  const bool isFinishedLater = stepEnd_ == StepEnd::open && pair.isDone();
  const std::uint64_t later = isFinishedLater ? pair.work.promised.operations : 0;
  if (const std::uint64_t whole = charge(pair, budget.used() - bookedUntil_ + later); whole > 0)
    usualOperations_ += kLearning * (static_cast<double>(whole) - usualOperations_);
  bookedUntil_ = budget.used();
}

void NarrowPhase::Impl::turnEnded(std::size_t index, Progress progress, Budget& budget) {
  TreePair* const pair = collected_[index];
  if (!pair) return;
  promise(*pair, budget, pace_);
  bookTo(*pair, budget);
  if (progress == Progress::done && finishesResolvedAtOnce()) finishPair(index);
}

void NarrowPhase::Impl::finishPair(std::size_t index) {
  TreePair& pair = *collected_[index];
  const bool isTimed = left_.hasDeadline();
  const double expected = pair.work.promised.nanoseconds;
  const auto began = isTimed ? Budget::Clock::now() : Budget::Clock::time_point();
  btManifoldResult result(&pair.bodies.body0(), &pair.bodies.body1());
  const ScheduledPair seen = bullet::scheduled(pair);
  const PairReport report = bullet::finish(pair, dispatcher_, result, answerPolicy(), left_, scratch_);
  count(report, seen);
  // Triangles take what is left: were they expected, they would keep others from their leaves.
  if (isTimed) pace_.finished(expected, Budget::Clock::now() - began - report.onTriangles);
  if (collected_[index]) bookTo(pair, left_);
  dismiss(index);
}

// Unless its own callbacks have destroyed it.
void NarrowPhase::Impl::dismiss(std::size_t index) {
  if (collected_[index]) collected_[index]->notes.collectedAt = PairNotes::kNowhere;
  collected_[index] = nullptr;
  if (index < scheduled_.size()) scheduled_[index].traversal = &nothing_;
}

void NarrowPhase::Impl::nameNewPairs() {
  newPairs_.clear();
  for (std::size_t i = 0; i < collected_.size(); ++i) {
    if (i + kNamesAhead < collected_.size()) fetch(*collected_[i + kNamesAhead], PairPart::notes);
    if (collected_[i]->notes.isUnnamed()) newPairs_.push_back({collected_[i]->bodies.key(i), collected_[i]});
  }
  std::sort(newPairs_.begin(), newPairs_.end(), [](const NewPair& x, const NewPair& y) { return x.key < y.key; });
  for (const NewPair& fresh : newPairs_) fresh.pair->notes.id = nextId_++;
}

// What was counted.
PairReport NarrowPhase::Impl::count(PairReport report, const ScheduledPair& pair) {
  const auto size = static_cast<double>(pair.size);
  if (viewer_) report.seenError = seenError(sightOf(*viewer_, pair.center, size / 2), report.errorFraction * size);
  tally_.add(report);
  return report;
}

}  // namespace cairn::bullet
