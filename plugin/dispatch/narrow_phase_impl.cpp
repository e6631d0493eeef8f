// SPDX-License-Identifier: Zlib
#include "dispatch/narrow_phase_impl.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <typeinfo>
#include <utility>

namespace cairn::bullet {

namespace {

bool isOwnedBy(const btCollisionObject& object, btOverlappingPairCache& pairs) {
  auto* ghost = dynamic_cast<const btPairCachingGhostObject*>(&object);
  return ghost && const_cast<btPairCachingGhostObject*>(ghost)->getOverlappingPairCache() == &pairs;
}

// A ghost object keeps its own pairs and has them dispatched whenever a character looks around; every one of them
// contains the ghost, so the first tells.
bool isGhostCache(btOverlappingPairCache& pairs) {
  const btBroadphasePair& first = *pairs.getOverlappingPairArrayPtr();
  return isOwnedBy(*static_cast<const btCollisionObject*>(first.m_pProxy0->m_clientObject), pairs) ||
         isOwnedBy(*static_cast<const btCollisionObject*>(first.m_pProxy1->m_clientObject), pairs);
}

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
    : dispatcher_(dispatcher), stepEnd_(stepEnd), priority_(std::make_unique<RoundRobin>()) {
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
  if (status) budget_ = budget;
  return status;
}

Status NarrowPhase::Impl::setFrameBudget(const StepBudget& budget) {
  const Status status = check(budget, "a frame");
  if (!status) return status;
  frame_ = FrameBudget(budget);
  hasFrameBudget_ = budget.operations || budget.microseconds;
  return {};
}

void NarrowPhase::Impl::beginFrame(int steps) {
  if (stepEnd_ == StepEnd::open) endOpenStep();
  frame_.begin(steps);
}

void NarrowPhase::Impl::setPriority(std::unique_ptr<Priority> priority) {
  assert(priority);
  priority_ = std::move(priority);
}

TreePair* NarrowPhase::Impl::acquire(CounterpartKind kind) {
  const std::lock_guard lock(mutex_);
  std::vector<TreePair*>& idle = idle_[static_cast<std::size_t>(kind)];
  if (idle.empty()) return all_.emplace_back(std::make_unique<TreePair>(kind)).get();
  TreePair* const pair = idle.back();
  idle.pop_back();
  return pair;
}

void NarrowPhase::Impl::release(TreePair* pair) {
  const std::lock_guard lock(mutex_);
  if (pair->collectedAt() != TreePair::kNotCollected) collected_[pair->collectedAt()] = nullptr;
  open_.forget(*pair);
  pair->reset();
  idle_[static_cast<std::size_t>(pair->kind())].push_back(pair);
}

void NarrowPhase::Impl::beginStep(btOverlappingPairCache& pairs, const btDispatcherInfo& info) {
  isCollecting_ = isWorlds(pairs);
  if (!isCollecting_) return;
  stepBegan_ = ThreadCpuClock::now();
  timeStep_ = info.m_timeStep;
  collected_.clear();
}

// A cache without pairs does not say whose it is: it counts as the world's if it had the world's pairs before.
bool NarrowPhase::Impl::isWorlds(btOverlappingPairCache& pairs) {
  if (pairs.getNumOverlappingPairs() == 0) return !worldPairs_ || worldPairs_ == &pairs;
  if (isGhostCache(pairs)) return false;
  worldPairs_ = &pairs;
  return true;
}

void NarrowPhase::Impl::process(TreePair& pair, const btCollisionObjectWrapper& body0,
                                const btCollisionObjectWrapper& body1, const btDispatcherInfo& info,
                                btManifoldResult& result, bool mayDefer) {
  // A result of another class belongs to a query, which wants its points before this returns.
  const bool isPlain = typeid(result) == typeid(btManifoldResult) && result.m_closestPointDistanceThreshold <= 0;
  if (mayDefer && isPlain && !isRetired_) {
    if (isCollecting_ && collect(pair, body0, body1)) return;
    if (stepEnd_ == StepEnd::open && answerInOpenStep(pair, body0, body1, info, result)) return;
  }
  answerAtOnce(pair, body0, body1, info, result);
}

bool NarrowPhase::Impl::collect(TreePair& pair, const btCollisionObjectWrapper& body0,
                                const btCollisionObjectWrapper& body1) {
  if (!pair.collect(body0, body1)) return false;
  const std::lock_guard lock(mutex_);
  pair.setCollectedAt(collected_.size());
  collected_.push_back(&pair);
  return true;
}

void NarrowPhase::Impl::answerAtOnce(TreePair& pair, const btCollisionObjectWrapper& body0,
                                     const btCollisionObjectWrapper& body1, const btDispatcherInfo& info,
                                     btManifoldResult& result) {
  Budget budget = Budget::unlimited();
  if (!pair.begin(body0, body1, info.m_timeStep, result.m_closestPointDistanceThreshold, budget)) return;
  pair.scheduled().traversal->refine(budget);
  ContactScratch scratch;  // queries may come from any thread
  pair.finish(dispatcher_, result, policy_, false, budget, scratch);
}

Budget NarrowPhase::Impl::budgetOf(const StepBudget& limit) {
  const std::uint64_t operations =
      limit.operations ? static_cast<std::uint64_t>(*limit.operations) : Budget::kUnlimited;
  return limit.microseconds ? Budget::both(operations, *limit.microseconds) : Budget::operations(operations);
}

bool NarrowPhase::Impl::mayBeInterrupted() const {
  return budget_.operations || budget_.microseconds || hasFrameBudget_;
}

void NarrowPhase::Impl::endStep() {
  if (!isCollecting_) return;
  isCollecting_ = false;
  isAnswering_ = true;
  statistics_ = {};
  errorSum_ = 0;
  reportingPairs_ = 0;

  const Budget::Clock::time_point began = Budget::Clock::now();
  Budget budget = budgetOf(stepLimit());
  beginPairs(budget);
  scheduler_.run(scheduled_, *priority_, budget);
  finishPairs(budget);
  isAnswering_ = false;

  statistics_.operations = budget.used();
  if (reportingPairs_ > 0) statistics_.meanErrorFraction = errorSum_ / reportingPairs_;
  const std::chrono::duration<double, std::micro> elapsed = Budget::Clock::now() - began;
  frame_.spend(budget.used(), elapsed.count());
  const std::chrono::duration<double, std::micro> spent = ThreadCpuClock::now() - stepBegan_;
  statistics_.microseconds = spent.count();
}

// Drops what was destroyed meanwhile, names what is new and orders everything by name. Until a pair is finished, a
// user's callback may still destroy it.
void NarrowPhase::Impl::beginPairs(Budget& budget) {
  std::erase(collected_, nullptr);
  nameNewPairs();
  std::sort(collected_.begin(), collected_.end(),
            [](const TreePair* x, const TreePair* y) { return x->id() < y->id(); });
  for (std::size_t i = 0; i < collected_.size(); ++i) collected_[i]->setCollectedAt(i);
  for (std::size_t i = 0; i < collected_.size(); ++i)
    if (TreePair* pair = collected_[i]; pair && !pair->begin(pair->body0(), pair->body1(), timeStep_, 0, budget))
      dismiss(i);
  scheduled_.clear();
  for (TreePair* pair : collected_)
    if (pair) scheduled_.push_back(pair->scheduled());
  statistics_.pairs = static_cast<std::uint32_t>(scheduled_.size());
}

// Unless its own callbacks have destroyed it.
void NarrowPhase::Impl::dismiss(std::size_t index) {
  if (collected_[index]) collected_[index]->setCollectedAt(TreePair::kNotCollected);
  collected_[index] = nullptr;
}

void NarrowPhase::Impl::nameNewPairs() {
  newPairs_.clear();
  for (std::size_t i = 0; i < collected_.size(); ++i)
    if (collected_[i]->isUnnamed()) newPairs_.push_back({collected_[i]->key(i), collected_[i]});
  std::sort(newPairs_.begin(), newPairs_.end(), [](const NewPair& x, const NewPair& y) { return x.key < y.key; });
  for (const NewPair& fresh : newPairs_) fresh.pair->setId(nextId_++);
}

void NarrowPhase::Impl::finishPairs(Budget& budget) {
  for (std::size_t i = 0; i < collected_.size(); ++i) {
    TreePair* const pair = collected_[i];
    if (!pair) continue;
    btManifoldResult result(&pair->body0(), &pair->body1());
    count(pair->finish(dispatcher_, result, policy_, mayBeInterrupted(), budget, scratch_));
    dismiss(i);
  }
}

void NarrowPhase::Impl::count(const PairReport& report) {
  statistics_.unresolvedPairs += report.isUnresolved ? 1 : 0;
  statistics_.contacts += report.contacts;
  statistics_.manifolds += report.manifolds;
  statistics_.worstErrorFraction = std::max(statistics_.worstErrorFraction, report.errorFraction);
  if (report.contacts == 0) return;
  errorSum_ += report.errorFraction;
  ++reportingPairs_;
}

}  // namespace cairn::bullet
